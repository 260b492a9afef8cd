//! Reads the machine's text form, which [`disassemble`](crate::machine::disassemble) writes.
//!
//! A line is a declaration, an instruction, or a label (`name:`); `//` begins a comment. Things are
//! numbered in the order of their declarations and named by kind and number: `enum0`, `type0` (an
//! object type), `c0` (a scalar constant), `t0` (a text), `h0` (an import of the host), `f0`.
//!
//! ```text
//! program Race
//! file "race.starl" 0 16 17 32
//! enum Location init pick wait
//! type List[Point]
//! constant 0.075
//! text "arrived"
//! parameter vicinity Float
//! required patience Duration in 0x3b9aca00 0x2540be400
//! variable target type0
//! import position query () (Point)
//! import emit (type1) () labels index
//! primitive motion ReachAvoid
//! defaults f9
//! start f0
//! action pick f1 f2
//! action count f10 f11 atomic 1
//! action rest f12 f13 hold f14 every f15
//! check reset f16 f17
//! handler Reached f3
//! handler done primitive 0 f4
//! handler go_to input f5 place hurry
//! property in_order 1 always f5
//! property all_done 0 eventually f6 within 120000000000
//! property answered 1 leads_to f7 f8 within 5000000000
//! property even 2 eventually_always f7 within 5000000000 assuming f9 recovers 1000000000 despite_crashes
//! function fib function (Int) (Int) registers 4 objects 0
//! span 0 120 140
//!     jump_if_less_constant r0 2 @done
//! ...
//! done:
//!     return_scalar r0 #0
//! ```
//!
//! `file` gives the bytes at which its lines begin. A `parameter` may be set by the host, one that is
//! `required` must be, `in` is followed by the least value and the first beyond the greatest. `span` gives the source of the instructions after it: file, first byte, byte after the last. A
//! jump names a label of its function with `@` before it.

use crate::machine::bytecode::{
    Action, Binding, Bytecode, Claim, Enum, Function, FunctionKind, Handler, Origin, Parameter,
    Property, Range, SourceFile, Span, Variable,
};
use crate::machine::host::Import;
use crate::machine::instruction::Instruction;
use crate::machine::text::types::Cursor;
use alloc::collections::BTreeMap;
use alloc::string::String;
use alloc::vec::Vec;
use thiserror::Error;

/// An error in the text form of a program.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("line {line}: {reason}")]
pub struct AssemblyError {
    /// The line, counted from one.
    pub line: u32,
    /// The reason.
    pub reason: &'static str,
}

/// Reads a program's text form. The bytecode is not verified.
pub fn assemble(text: &str) -> Result<Bytecode, AssemblyError> {
    let mut assembler = Assembler::default();
    for (index, line) in text.lines().enumerate() {
        assembler.line = index as u32 + 1;
        let line = line.trim();
        // A text may hold what would begin a comment.
        let result = match line.split_once(' ') {
            Some(("text", quoted)) => assembler.text(quoted),
            Some(("file", rest)) => assembler.file(rest),
            _ => assembler.read(line.split("//").next().unwrap_or("").trim()),
        };
        result.map_err(|reason| assembler.error(reason))?;
    }
    assembler.end_function()?;
    Ok(assembler.bytecode)
}

#[derive(Default)]
struct Assembler {
    bytecode: Bytecode,
    line: u32,
    /// The labels of the function that is being read.
    labels: BTreeMap<String, u32>,
    /// Its instructions, with their lines: they are read at its end, when labels are known.
    pending: Vec<(u32, String)>,
}

impl Assembler {
    fn error(&self, reason: &'static str) -> AssemblyError {
        let line = self.line;
        AssemblyError { line, reason }
    }

    /// The index of the next instruction.
    fn next(&self) -> u32 {
        (self.bytecode.code.len() + self.pending.len()) as u32
    }

    fn read(&mut self, line: &str) -> Result<(), &'static str> {
        let mut cursor = Cursor::new(line);
        let Some(first) = cursor.word() else {
            return Ok(());
        };
        if let Some(label) = first.strip_suffix(':') {
            let next = self.next();
            return match self.labels.insert(label.into(), next) {
                None => Ok(()),
                Some(_) => Err("there is a label of this name already"),
            };
        }
        let read = match first {
            "program" => cursor.word().map(|name| self.bytecode.name = name.into()),
            "enum" => self.enumeration(&mut cursor),
            "type" => cursor.object().map(|o| self.bytecode.types.push(o)),
            "constant" => constant(&mut cursor).map(|c| self.bytecode.constants.push(c)),
            "variable" => self.variable(&mut cursor, Parameter::No),
            "parameter" => self.variable(&mut cursor, Parameter::Optional),
            "required" => self.variable(&mut cursor, Parameter::Required),
            "stable" => self.stable(&mut cursor),
            "import" => self.import(&mut cursor),
            "primitive" => self.primitive(&mut cursor),
            "defaults" => cursor
                .numbered("f")
                .map(|f| self.bytecode.defaults = Some(f)),
            "start" => cursor.numbered("f").map(|f| self.bytecode.start = Some(f)),
            "action" => self.action(&mut cursor, false),
            "check" => self.action(&mut cursor, true),
            "handler" => self.handler(&mut cursor),
            "property" => self.property(&mut cursor),
            "function" => {
                self.end_function().map_err(|error| error.reason)?;
                self.function(&mut cursor)
            }
            _ if self.bytecode.functions.is_empty() => None,
            "span" => self.span(&mut cursor),
            _ => {
                self.pending.push((self.line, line.into()));
                return Ok(());
            }
        };
        match read {
            Some(()) if cursor.rest().is_empty() => Ok(()),
            _ => Err("this is not a declaration, label or instruction"),
        }
    }

    /// Reads the instructions of the function that ends here.
    fn end_function(&mut self) -> Result<(), AssemblyError> {
        let labels = core::mem::take(&mut self.labels);
        for (line, text) in core::mem::take(&mut self.pending) {
            let words: Vec<&str> = text.split_whitespace().collect();
            let label = |name: &str| labels.get(name).copied();
            let Some(instruction) = Instruction::read(&words, &label) else {
                let reason = "this is not an instruction with these operands";
                return Err(AssemblyError { line, reason });
            };
            self.bytecode.code.push(instruction);
        }
        if let Some(function) = self.bytecode.functions.last_mut() {
            function.end = self.bytecode.code.len() as u32;
        }
        Ok(())
    }

    fn text(&mut self, quoted: &str) -> Result<(), &'static str> {
        let text = unquote(quoted.trim()).ok_or("this is not a text in quotes")?;
        self.bytecode.texts.push(text);
        Ok(())
    }

    fn file(&mut self, rest: &str) -> Result<(), &'static str> {
        let end = rest.rfind('"').map_or(0, |quote| quote + 1);
        let name = unquote(rest[..end].trim()).ok_or("this is not a name in quotes")?;
        let numbers = rest[end..].split_whitespace().map(str::parse);
        let lines = numbers.collect::<Result<_, _>>();
        let lines = lines.map_err(|_| "lines begin at bytes")?;
        self.bytecode.files.push(SourceFile { name, lines });
        Ok(())
    }

    fn enumeration(&mut self, cursor: &mut Cursor<'_>) -> Option<()> {
        let name = cursor.word()?.into();
        let variants = words(cursor);
        self.bytecode.enums.push(Enum { name, variants });
        Some(())
    }

    fn variable(&mut self, cursor: &mut Cursor<'_>, parameter: Parameter) -> Option<()> {
        let name = cursor.word()?.into();
        let kind = cursor.kind(0)?;
        let range = match cursor.eat("in ") {
            true => Some(Range {
                from: constant(cursor)?,
                before: constant(cursor)?,
            }),
            false => None,
        };
        self.bytecode.variables.push(Variable {
            name,
            kind,
            parameter,
            range,
            is_stable: false,
        });
        Some(())
    }

    fn stable(&mut self, cursor: &mut Cursor<'_>) -> Option<()> {
        self.variable(cursor, Parameter::No)?;
        self.bytecode.variables.last_mut()?.is_stable = true;
        Some(())
    }

    fn import(&mut self, cursor: &mut Cursor<'_>) -> Option<()> {
        let name = cursor.word()?.into();
        let query = cursor.eat("query");
        let arguments = cursor.types()?;
        let results = cursor.types()?;
        let labels = match cursor.eat("labels") {
            true => words(cursor),
            false => Vec::new(),
        };
        self.bytecode.imports.push(Import {
            name,
            query,
            labels,
            arguments,
            results,
        });
        Some(())
    }

    fn primitive(&mut self, cursor: &mut Cursor<'_>) -> Option<()> {
        let name = cursor.word()?.into();
        let kind = cursor.word()?.into();
        self.bytecode.primitives.push(Binding { name, kind });
        Some(())
    }

    fn action(&mut self, cursor: &mut Cursor<'_>, is_check: bool) -> Option<()> {
        let name = cursor.word()?.into();
        let guard = cursor.numbered("f")?;
        let effect = cursor.numbered("f")?;
        let hold = optional(cursor, "hold")?;
        let every = optional(cursor, "every")?;
        let is_atomic = cursor.eat("atomic");
        let words = words(cursor)
            .into_iter()
            .take(if is_atomic { usize::MAX } else { 0 });
        let atomic: Option<Vec<u32>> = words.map(|word| word.parse().ok()).collect();
        self.bytecode.actions.push(Action {
            name,
            guard,
            effect,
            atomic: atomic?,
            is_check,
            hold,
            every,
        });
        Some(())
    }

    fn handler(&mut self, cursor: &mut Cursor<'_>) -> Option<()> {
        let event = cursor.word()?.into();
        let (origin, function) = if cursor.eat("primitive") {
            let primitive = cursor.word()?.parse().ok()?;
            (Origin::Primitive(primitive), cursor.numbered("f")?)
        } else if cursor.eat("input") {
            let function = cursor.numbered("f")?;
            let fields = core::iter::from_fn(|| cursor.word());
            (Origin::Input(fields.map(String::from).collect()), function)
        } else {
            (Origin::Message, cursor.numbered("f")?)
        };
        self.bytecode.handlers.push(Handler {
            event,
            origin,
            function,
        });
        Some(())
    }

    fn property(&mut self, cursor: &mut Cursor<'_>) -> Option<()> {
        let name = cursor.word()?.into();
        let robots = cursor.word()?.parse().ok()?;
        let claim = match cursor.word()? {
            "always" => Claim::Always(cursor.numbered("f")?),
            "eventually" => Claim::Eventually {
                holds: cursor.numbered("f")?,
                within: number(cursor, "within")?,
            },
            "eventually_always" => Claim::EventuallyAlways {
                holds: cursor.numbered("f")?,
                within: number(cursor, "within")?,
            },
            "leads_to" => Claim::LeadsTo {
                cause: cursor.numbered("f")?,
                consequence: cursor.numbered("f")?,
                within: number(cursor, "within")?,
            },
            _ => return None,
        };
        self.bytecode.properties.push(Property {
            name,
            claim,
            robots,
            assumption: optional(cursor, "assuming")?,
            recovery: number(cursor, "recovers")?,
            is_despite_crashes: cursor.eat("despite_crashes"),
        });
        Some(())
    }

    fn function(&mut self, cursor: &mut Cursor<'_>) -> Option<()> {
        let name = cursor.word()?.into();
        let kind = match cursor.word()? {
            "function" => FunctionKind::Function,
            "guard" => FunctionKind::Guard,
            "procedure" => FunctionKind::Procedure,
            "property" => FunctionKind::Property,
            _ => return None,
        };
        let arguments = cursor.types()?;
        let results = cursor.types()?;
        let registers = cursor.eat("registers").then(|| cursor.word())??;
        let objects = cursor.eat("objects").then(|| cursor.word())??;
        let entry = self.next();
        self.bytecode.functions.push(Function {
            name,
            kind,
            entry,
            end: entry,
            registers: registers.parse().ok()?,
            object_registers: objects.parse().ok()?,
            arguments,
            results,
        });
        Some(())
    }

    fn span(&mut self, cursor: &mut Cursor<'_>) -> Option<()> {
        let span = Span {
            file: cursor.word()?.parse().ok()?,
            start: cursor.word()?.parse().ok()?,
            end: cursor.word()?.parse().ok()?,
        };
        let next = self.next();
        self.bytecode.spans.push((next, span));
        Some(())
    }
}

fn words(cursor: &mut Cursor<'_>) -> Vec<String> {
    core::iter::from_fn(|| cursor.word().map(String::from)).collect()
}

/// A number after a word, if that is next.
fn number(cursor: &mut Cursor<'_>, word: &str) -> Option<Option<u64>> {
    match cursor.eat(word) {
        true => Some(Some(cursor.word()?.parse().ok()?)),
        false => Some(None),
    }
}

/// A function after a word, if that is next.
fn optional(cursor: &mut Cursor<'_>, word: &str) -> Option<Option<u32>> {
    match cursor.eat(word) {
        true => Some(Some(cursor.numbered("f")?)),
        false => Some(None),
    }
}

/// A scalar constant: a Float if it has a point or an exponent, bits if it begins with `0x`, else an
/// Int.
fn constant(cursor: &mut Cursor<'_>) -> Option<u64> {
    let word = cursor.word()?;
    if let Some(digits) = word.strip_prefix("0x") {
        return u64::from_str_radix(digits, 16).ok();
    }
    if word.contains(['.', 'e']) {
        return word.parse().ok().map(f64::to_bits);
    }
    word.parse().ok().map(|number: i64| number as u64)
}

/// The text between quotes, with `\n`, `\t`, `\r`, `\"`, `\\` and `\u{..}` replaced.
fn unquote(quoted: &str) -> Option<String> {
    let inner = quoted.strip_prefix('"')?.strip_suffix('"')?;
    let mut text = String::new();
    let mut rest = inner.chars();
    while let Some(character) = rest.next() {
        text.push(match character {
            '\\' => match rest.next()? {
                'n' => '\n',
                't' => '\t',
                'r' => '\r',
                '0' => '\0',
                'u' => {
                    let mut digits = rest.as_str().strip_prefix('{')?.splitn(2, '}');
                    let code = u32::from_str_radix(digits.next()?, 16).ok()?;
                    rest = digits.next()?.chars();
                    char::from_u32(code)?
                }
                other @ ('"' | '\\' | '\'') => other,
                _ => return None,
            },
            '"' => return None,
            other => other,
        });
    }
    Some(text)
}
