//! Hints for names that nothing has: primitives that are not bound, and habits from other languages.

use alloc::format;
use alloc::string::{String, ToString};

use super::body::Where;
use super::state::Checker;
use super::tables::{PRIMITIVES, Primitive};
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
        if let Some((_, note)) = HABITS.iter().find(|(word, _)| *word == name) {
            return problem.note(*note);
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

    /// Adds the fix for `self.x`, which is written `x`.
    pub(super) fn without_self(
        &self,
        problem: &Diagnostic,
        name: &str,
        span: Span,
    ) -> Option<Diagnostic> {
        if !matches!(name, "self" | "this") || self.member_after(span).is_empty() {
            return None;
        }
        let dot = Span::new(span.start, span.end + 1);
        let member = self.member_after(span);
        let form = format!("write `{member}`; a program's variables are used by their names");
        Some(problem.clone().replace(form, dot, ""))
    }

    /// Whether the name at the place is used as a primitive: its flag or method follows.
    pub(super) fn is_of_primitive(&self, span: Span) -> bool {
        let member = self.member_after(span);
        PRIMITIVES.iter().any(|kind| kind.member(member).is_some())
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
        let mut having = PRIMITIVES
            .iter()
            .filter(|kind| kind.member(member).is_some());
        let Some(first) = having.next() else {
            return problem;
        };
        if let Some(bound) = self.only_binding_with(member) {
            return problem.replace(format!("did you mean `{bound}`?"), span, bound);
        }
        let usual = PRIMITIVES.iter().find(|kind| usual_name(kind) == name);
        let usual = usual.filter(|kind| kind.member(member).is_some());
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
        let mut having = PRIMITIVES
            .iter()
            .filter(|kind| kind.member(method).is_some());
        let Some(kind) = having.next() else {
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
        "Mutex" | "Registration" | "LeaderElection" | "Barrier" => "(\"0\")",
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

/// Whether the name is known from other languages.
pub(super) fn is_habit(name: &str) -> bool {
    HABITS.iter().any(|(word, _)| *word == name)
}

/// Names that other languages have, and what takes their place.
const HABITS: &[(&str, &str)] = &[
    (
        "len",
        "lists, sets, maps and texts have a size: `xs.size()`",
    ),
    (
        "length",
        "lists, sets, maps and texts have a size: `xs.size()`",
    ),
    ("range", "`for i in 0..n` counts from 0 to below `n`"),
    (
        "enumerate",
        "`for i in 0..xs.size()` counts the elements, and `xs[i]` is one",
    ),
    ("sum", "a list has a sum: `xs.sum()`"),
    (
        "sorted",
        "a list can be sorted: `xs.sorted()`, or `[x for x in xs by key]`",
    ),
    ("any", "write `exists x in xs: condition`"),
    ("all", "write `forall x in xs: condition`"),
    ("filter", "write `[x for x in xs if condition]`"),
    ("map", "write `[f(x) for x in xs]`"),
    (
        "sleep",
        "nothing waits in an effect: write `pre condition for 5s`, or `every 5s`, in an action",
    ),
    (
        "wait",
        "nothing waits in an effect: write `pre condition for 5s`, or `every 5s`, in an action",
    ),
    (
        "delay",
        "nothing waits in an effect: write `pre condition for 5s`, or `every 5s`, in an action",
    ),
    (
        "assert",
        "declare a property, `always name: condition`, which is judged on every run",
    ),
    (
        "lambda",
        "functions are not values: declare one with `function`",
    ),
    (
        "Motion",
        "bind a primitive, `motion = ReachAvoid()`: `motion.reach_avoid(target, obstacles())` drives, and \
         `motion.done` is true on arrival",
    ),
];
