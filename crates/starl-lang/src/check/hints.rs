//! Hints for names that nothing has: primitives that are not bound, and habits from other languages.

use alloc::format;
use alloc::string::{String, ToString};

use super::body::Where;
use super::state::Checker;
use super::tables::Primitive;
use crate::diagnostic::{Diagnostic, Span};

impl Checker {
    /// Adds a note about the name, which nothing has, or the fix; nothing if there is no hint.
    pub(super) fn hint(&self, problem: Diagnostic, name: &str, span: Span) -> Diagnostic {
        if self.is_beyond_leads_to(name, span) {
            return problem.note(format!(
                "the quantifier of `{name}` does not extend over `leads_to`; without one, the property is judged for each \
                 robot, with its own variables"
            ));
        }
        if let Some(note) = habit(name) {
            let problem = problem.note(note);
            return match self.rewritten(name, span) {
                Some((whole, form)) => problem.write(whole, form),
                None => problem,
            };
        }
        let member = self.member_after(span);
        if !member.is_empty() {
            return self.unbound(problem, name, member, span);
        }
        let method = match name {
            "goto" | "go_to" | "move_to" | "moveTo" | "drive_to" | "fly_to" | "navigate"
            | "doReachAvoid" => "reach_avoid",
            "Broadcast" | "bcast" | "publish" => "broadcast",
            "send_to" | "unicast" => "send",
            "do_mutex" | "lock" => "acquire",
            "do_election" => "elect",
            "do_register" => "register",
            name => name,
        };
        self.method_without_primitive(problem, method, span)
    }

    /// Whether the name stands after a `leads_to`, before which a quantifier of the same property names it.
    fn is_beyond_leads_to(&self, name: &str, span: Span) -> bool {
        if self.body.place != Where::Property {
            return false;
        }
        let source = &self.files[self.file as usize].checked.source;
        let before = source.get(..span.start as usize).unwrap_or_default();
        let Some((before, _)) = before.rsplit_once("leads_to") else {
            return false;
        };
        let start = before.rfind("always").or_else(|| before.rfind("invariant"));
        let property = &before[start.unwrap_or_default()..];
        let is_separator = |c: char| !c.is_ascii_alphanumeric() && c != '_';
        let mut words = property.split(is_separator).filter(|word| !word.is_empty());
        words.any(|word| word == "forall" || word == "exists") && words.any(|word| word == name)
    }

    /// The place and StarL's form of the call of a function of another language at the place.
    fn rewritten(&self, name: &str, span: Span) -> Option<(Span, String)> {
        let inner = self.arguments_after(span)?;
        let text = self.text(inner).trim();
        let is_plain = text
            .chars()
            .all(|c| c.is_ascii_alphanumeric() || matches!(c, '_' | '.'));
        let method = match name {
            "len" | "length" => "size",
            "sum" | "sorted" | "reversed" => name,
            "range" => "",
            _ => return None,
        };
        let form = match (method, text.split_once(',')) {
            (_, None) if text.is_empty() => return None,
            ("", None) if is_plain => format!("0..{text}"),
            ("", None) => format!("0..({text})"),
            ("", Some((_, rest))) if rest.contains(',') => return None,
            ("", Some((start, end))) => format!("{}..{}", start.trim(), end.trim()),
            (_, Some(_)) => return None,
            (method, None) if is_plain => format!("{text}.{method}()"),
            (method, None) => format!("({text}).{method}()"),
        };
        Some((Span::new(span.start, inner.end + 1), form))
    }

    /// The text between the brackets that follow the place.
    pub(super) fn arguments_after(&self, span: Span) -> Option<Span> {
        let source = &self.files[self.file as usize].checked.source;
        let rest = source.get(span.end as usize..)?.strip_prefix('(')?;
        let mut open = 0_u32;
        let end = rest.char_indices().find(|(_, character)| {
            match character {
                '(' | '[' | '{' => open += 1,
                ')' | ']' | '}' if open > 0 => open -= 1,
                ')' | '\n' | '"' => return true,
                _ => {}
            }
            false
        });
        let (end, _) = end.filter(|(_, character)| *character == ')')?;
        let start = span.end + 1;
        Some(Span::new(start, start + end as u32))
    }

    /// Adds the fix for `2m/s`: a unit is not divided, and a speed is a Float.
    pub(super) fn quotient_of_units(
        &self,
        problem: &Diagnostic,
        name: &str,
        span: Span,
    ) -> Option<Diagnostic> {
        let divisor = match name {
            "s" => "",
            "min" => " / 60.0",
            "h" => " / 3600.0",
            _ => return None,
        };
        let before = self.text(Span::new(0, span.start)).strip_suffix('/')?;
        let number = before.trim_end_matches(|letter: char| letter.is_ascii_alphabetic());
        if number.len() == before.len() || !number.ends_with(|digit: char| digit.is_ascii_digit()) {
            return None;
        }
        let note = "units are not divided: a speed is a Float in metres per second, or in radians per second";
        let quotient = Span::new(span.start - 1, span.end);
        let form = match divisor {
            "" => "remove `/s`".into(),
            divisor => format!("write `{}`", divisor.trim()),
        };
        Some(problem.clone().note(note).replace(form, quotient, divisor))
    }

    /// Adds the fix for a method of another language, or a note: the receiver has no `name` at the place `at`.
    pub(super) fn member_hint(
        &self,
        problem: Diagnostic,
        receiver: Span,
        name: &str,
        at: Span,
    ) -> Diagnostic {
        let end = self
            .arguments_after(at)
            .map_or(at.end, |inner| inner.end + 1);
        let (whole, rest) = (Span::new(receiver.start, end), Span::new(at.start, end));
        let value = self.text(receiver);
        let (form, span) = match name {
            "is_empty" | "isEmpty" | "empty" => ("size() == 0".into(), rest),
            "to_string" | "toString" => (format!("String({value})"), whole),
            "to_float" | "toFloat" => (format!("Float({value})"), whole),
            "to_int" | "toInt" => (format!("Int({value})"), whole),
            _ => {
                return problem.note_if(member_habit(name));
            }
        };
        problem.write(span, form)
    }

    /// Adds the fix for `self.x`, which is written `x`.
    pub(super) fn without_self(
        &self,
        problem: &Diagnostic,
        name: &str,
        span: Span,
    ) -> Option<Diagnostic> {
        let member = self.member_after(span);
        let reason = match name {
            _ if member.is_empty() => return None,
            "self" | "this" => "a program's variables are used by their names",
            "math" | "Math" | "np" | "numpy" | "time" | "console" | "sys" | "std" => {
                "functions are used by their names"
            }
            _ => return None,
        };
        let dot = Span::new(span.start, span.end + 1);
        let form = format!("write `{member}`; {reason}");
        Some(problem.clone().replace(form, dot, ""))
    }

    /// Whether the name at the place is used as a primitive: its flag or method follows.
    pub(super) fn is_of_primitive(&self, span: Span) -> bool {
        Primitive::with_member(self.member_after(span))
            .next()
            .is_some()
    }

    /// The name after the dot that follows the place, if there is one.
    fn member_after(&self, span: Span) -> &str {
        /// No member of a primitive has a longer name.
        const LONGEST: u32 = 64;
        let source = &self.files[self.file as usize].checked.source;
        let end = (span.end + LONGEST).min(source.len() as u32);
        let rest = source.get(span.end as usize..end as usize);
        // The piece may end within a character, which no name contains.
        let rest = rest
            .or_else(|| source.get(span.end as usize..))
            .unwrap_or_default();
        let Some(rest) = rest.strip_prefix('.') else {
            return "";
        };
        let end = rest.find(|next: char| !next.is_ascii_alphanumeric() && next != '_');
        &rest[..end.unwrap_or(rest.len())]
    }

    /// `motion.active` where nothing is called `motion`.
    fn unbound(&self, problem: Diagnostic, name: &str, member: &str, span: Span) -> Diagnostic {
        let Some(first) = Primitive::with_member(member).next() else {
            return problem;
        };
        if let Some(bound) = self.only_binding_with(member) {
            return problem.replace(format!("did you mean `{bound}`?"), span, bound);
        }
        let usual = Primitive::with_member(member).find(|kind| usual_name(kind) == name);
        let declaration = declaration(name, usual.unwrap_or(first));
        problem.note(format!(
            "`{member}` belongs to a primitive, which is declared outside of actions: `{declaration}`"
        ))
    }

    /// `broadcast(...)` where it must be `net.broadcast(...)`.
    fn method_without_primitive(
        &self,
        problem: Diagnostic,
        method: &str,
        span: Span,
    ) -> Diagnostic {
        let Some(kind) = Primitive::with_member(method).next() else {
            return problem;
        };
        if let Some(bound) = self.only_binding_with(method) {
            let form = format!("{bound}.{method}");
            return problem.replace(format!("did you mean `{form}`?"), span, form);
        }
        let name = usual_name(kind);
        let declaration = declaration(name, kind);
        problem.note(format!(
            "`{method}` belongs to a primitive: declare `{declaration}` outside of actions, and write `{name}.{method}`"
        ))
    }

    /// The only primitive of the program that has the method or flag.
    fn only_binding_with(&self, member: &str) -> Option<String> {
        let mut bound = (self.program.bindings.iter()).filter(|binding| {
            binding
                .primitive
                .is_some_and(|kind| kind.member(member).is_some())
        });
        match (bound.next(), bound.next()) {
            (Some(binding), None) => Some(binding.name.clone()),
            _ => None,
        }
    }
}

/// `motion = ReachAvoid()`.
fn declaration(name: &str, kind: &Primitive) -> String {
    let arguments = match kind.name() {
        "Mutex" | "Registration" | "LeaderElection" | "Barrier" => "(\"name\")",
        "Policy" => "(\"model.onnx\")",
        _ => "()",
    };
    name.to_string() + " = " + kind.name() + arguments
}

/// The name that the documentation gives to a primitive of the kind.
fn usual_name(kind: &Primitive) -> &'static str {
    match kind.name() {
        "ReachAvoid" => "motion",
        "Broadcast" => "net",
        "Geocast" => "cast",
        "Unicast" => "link",
        "LocalBroadcast" => "radio",
        "FailureDetector" => "detector",
        "Mutex" => "mux",
        "Registration" => "registration",
        "LeaderElection" => "election",
        "Barrier" => "barrier",
        _ => "policy",
    }
}

/// A note on a method that other languages have.
fn member_habit(name: &str) -> Option<&'static str> {
    Some(match name {
        "pop" | "pop_back" | "shift" => {
            "`xs.last()` reads the last element, and `xs.remove_at(xs.size() - 1)` removes it"
        }
        "clear" => "assign an empty one: `xs = []`, or `{}` for a set and `{:}` for a map",
        "put" | "set" | "insert" | "update" | "setdefault" => {
            "`m[key] = value` sets the value of a key"
        }
        "items" | "entries" => "`for k, v in m` goes over the keys and their values",
        "max" | "min" => "`max(x for x in xs)` is the greatest element, and none of an empty list",
        "map" | "filter" => "write `[f(x) for x in xs if condition]`",
        "extend" | "concat" | "addAll" => "`xs + ys` joins two lists",
        "norm" | "length" | "magnitude" | "len" => {
            "`distance(p, Point(0.0, 0.0))` is the length of a point"
        }
        "copy" | "clone" => "an assignment copies: `let y = x`",
        "get" | "at" => "`xs[i]` is the element at an index",
        _ => return None,
    })
}

/// A note on a name that other languages have.
pub(super) fn habit(name: &str) -> Option<&'static str> {
    Some(match name {
        "len" | "length" => "lists, sets, maps and texts have a size: `xs.size()`",
        "range" => "`for i in 0..n` counts from 0 to below `n`",
        "enumerate" => "`for i in 0..xs.size()` counts the elements, and `xs[i]` is one",
        "sum" => "a list has a sum: `xs.sum()`",
        "sorted" => "a list can be sorted: `xs.sorted()`, or `[x for x in xs by key]`",
        "reversed" => "a list can be reversed: `xs.reversed()`",
        "any" => "write `exists x in xs: condition`",
        "all" => "write `forall x in xs: condition`",
        "filter" => "write `[x for x in xs if condition]`",
        "map" => "write `[f(x) for x in xs]`",
        "sleep" | "wait" | "delay" => {
            "nothing waits in an effect: write `pre condition for 5s`, or `every 5s`, in an action"
        }
        "Duration" | "seconds" => "a number becomes a time by multiplication: `n * 1s`",
        "Time" => "a moment is `now`, or a sum such as `now + 5s`",
        "Bool" => "write a comparison, such as `n != 0`",
        "List" | "list" => "a list is written `[a, b]`, and an empty one `[]`",
        "Set" | "set" => "a set is written `{a, b}`, and an empty one `{}`",
        "Map" | "dict" => "a map is written `{k: v}`, and an empty one `{:}`",
        "assert" => "declare a property, `always name: condition`, which is judged on every run",
        "lambda" => "functions are not values: declare one with `function`",
        "Motion" => {
            "bind a primitive, `motion = ReachAvoid()`: `motion.reach_avoid(target, obstacles())` drives, and \
             `motion.done` is true on arrival"
        }
        _ => return None,
    })
}
