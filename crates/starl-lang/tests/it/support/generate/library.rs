//! Functions of the standard library, by the signatures in its text.

use super::Generator;
use super::model::{Function, Named, Type};
use starl_lang::check::STANDARD;

impl Generator<'_> {
    /// Imports some libraries; their functions may then be called.
    pub(super) fn imports(&mut self) {
        for (library, text) in STANDARD {
            if self.choices.below(6) < 5 {
                continue;
            }
            self.line(&format!("import {library}"));
            let functions = text
                .lines()
                .filter_map(|line| line.strip_prefix("function "));
            self.model
                .functions
                .extend(functions.filter_map(|line| function(library, line)));
        }
    }
}

/// `name(parameters) -> result`; none if a type is one of the library's own.
fn function(library: &str, line: &str) -> Option<Function> {
    let (name, rest) = line.split_once('(')?;
    let (parameters, result) = rest.split_once(") -> ")?;
    let parameters = if parameters.is_empty() {
        Vec::new()
    } else {
        split(parameters)
    };
    let parameters = parameters.into_iter().map(|parameter| {
        let (name, ty) = parameter.split_once(": ")?;
        Some(Named {
            name: name.into(),
            ty: written(ty)?,
        })
    });
    let result = result.split(" = ").next()?;
    Some(Function {
        name: format!("{library}.{name}"),
        parameters: parameters.collect::<Option<_>>()?,
        result: written(result)?,
        is_recursive: false,
    })
}

/// The parts between commas that are in no brackets.
fn split(text: &str) -> Vec<&str> {
    let (mut parts, mut start, mut depth) = (Vec::new(), 0, 0);
    for (at, character) in text.char_indices() {
        match character {
            '[' => depth += 1,
            ']' => depth -= 1,
            ',' if depth == 0 => {
                parts.push(text[start..at].trim());
                start = at + 1;
            }
            _ => {}
        }
    }
    parts.push(text[start..].trim());
    parts
}

/// A type as it is written, if it is one that every program knows.
fn written(text: &str) -> Option<Type> {
    let text = text.trim();
    if let Some(inner) = text.strip_suffix('?') {
        return Some(Type::optional(written(inner)?));
    }
    if let Some((of, parts)) = text.strip_suffix(']').and_then(|text| text.split_once('[')) {
        let parts = split(parts)
            .into_iter()
            .map(written)
            .collect::<Option<Vec<Type>>>()?;
        return match (of, &parts[..]) {
            ("List", [element]) => Some(Type::list(element.clone())),
            ("Set", [element]) => Some(Type::set(element.clone())),
            ("Map", [key, value]) => Some(Type::map(key.clone(), value.clone())),
            _ => None,
        };
    }
    Some(match text {
        "Bool" => Type::Bool,
        "Int" => Type::Int,
        "Float" => Type::Float,
        "String" => Type::String,
        "Point" => Type::Point,
        "Time" => Type::Time,
        "Duration" => Type::Duration,
        "RobotId" => Type::Robot,
        _ => return None,
    })
}
