//! Recovery after syntax errors.

use alloc::vec::Vec;

use super::{Code, Diagnostic, Parser, Span, SyntaxKind, SyntaxKind::*};
use crate::diagnostic::Edit;

impl Parser<'_> {
    /// Puts the rest of the line into an `Error`, if there is any.
    pub fn skip_to_line_end(&mut self) {
        if self.at_line_end() {
            return;
        }
        self.start(Error);
        while !self.at_line_end() {
            self.bump();
        }
        self.finish();
    }

    /// The same, with the whole of the block that follows.
    pub fn skip_line_and_block(&mut self) {
        self.start(Error);
        while !self.at_line_end() {
            self.bump();
        }
        if self.at_block() {
            self.bump();
            self.skip_block();
        }
        self.finish();
    }

    /// Takes everything from the indentation that is next to the end of its block.
    pub fn skip_block(&mut self) {
        let mut open = 0_u32;
        loop {
            match self.current() {
                Indent => open += 1,
                Dedent => open = open.saturating_sub(1),
                EndOfFile => return,
                _ => {}
            }
            self.bump();
            if open == 0 {
                return;
            }
        }
    }

    /// In brackets: puts everything before the next comma or closing bracket into an `Error`.
    pub fn skip_element(&mut self) {
        self.start(Error);
        let mut open = 0_u32;
        while !self.at_line_end() {
            match self.current() {
                Comma if open == 0 => break,
                kind if kind.closing().is_some() => open += 1,
                kind if kind.is_closing() && open == 0 => break,
                kind if kind.is_closing() => open -= 1,
                _ => {}
            }
            self.bump();
        }
        self.finish();
    }

    /// Parses the end of a statement or a declaration: the end of the line, or of the block.
    pub fn end_line(&mut self) {
        let after_block = self.previous() == Some(Dedent);
        if !self.at_line_end() && !after_block {
            self.unexpected(Newline.name());
            self.skip_to_line_end();
        }
        if !after_block && matches!(self.current(), Newline | Semicolon) {
            self.bump();
        }
    }

    /// Takes the closing bracket for the opening one at `open`, or reports that it is missing, unless
    /// that is known.
    pub fn close(&mut self, kind: SyntaxKind, open: Span) {
        if self.at(kind) {
            self.bump();
        } else if !self.is_unpaired(open.start) {
            self.unexpected(kind.name());
        } else if self.current().is_closing() && self.is_unpaired(self.span().start) {
            // The wrong one in its place.
            self.bump();
        }
    }

    /// A node of elements with commas between them, in the brackets that are next.
    pub fn bracketed(
        &mut self,
        kind: SyntaxKind,
        closing: SyntaxKind,
        element: impl FnMut(&mut Self),
    ) {
        let open = self.span();
        self.start(kind);
        self.bump();
        self.separated(closing, open, element);
        self.finish();
    }

    /// Elements with commas between them, from after the opening bracket at `open` to the closing one. Without one, the
    /// list ends with the line.
    pub fn separated(
        &mut self,
        closing: SyntaxKind,
        open: Span,
        mut element: impl FnMut(&mut Self),
    ) {
        let is_paired = !self.is_unpaired(open.start);
        while !self.current().is_closing() && !self.at_line_end() {
            let before = self.position;
            element(self);
            if is_paired && self.at(Semicolon) {
                self.semicolon();
                continue;
            }
            if self.eat(Comma) {
                continue;
            }
            if self.current().is_closing() || self.at_line_end() {
                break;
            }
            self.missing_comma(closing);
            if self.position == before || !self.starts_operand(0) {
                self.skip_element();
                self.eat(Comma);
            }
        }
        self.close(closing, open);
    }

    /// Takes a semicolon that stands for a comma.
    fn semicolon(&mut self) {
        let span = self.span();
        let message = "commas separate the elements in brackets";
        let problem = Diagnostic::new(Code::Unexpected, span, message);
        self.report(problem.write(span, ","));
        self.bump_error();
    }

    fn missing_comma(&mut self, closing: SyntaxKind) {
        if !self.starts_operand(0) {
            return self.unexpected(&alloc::format!("`,` or {}", closing.name()));
        }
        if self.last_error.replace(self.position) == Some(self.position) {
            return;
        }
        let place = Span::empty(self.end_of_last());
        if self.is_formatted_text() {
            let message = "texts do not contain values in braces";
            let problem = Diagnostic::new(Code::Unexpected, self.span(), message);
            let note = "write `log(\"x is {}\", x)`, or `\"x is \" + String(x)`";
            return self.report(problem.note(note));
        }
        let problem = Diagnostic::new(Code::Unexpected, place, "there is no comma between these");
        self.report(problem.label(self.span(), "this is the next").replace(
            "put a comma",
            place,
            ",",
        ));
    }

    /// Runs `parse` one level deeper, unless that is too deep: then the line and its block are skipped.
    pub fn deeper<T>(&mut self, parse: impl FnOnce(&mut Self) -> T) -> Option<T> {
        if self.depth >= super::MAX_DEPTH {
            self.too_deep();
            return None;
        }
        self.depth += 1;
        let parsed = parse(self);
        self.depth -= 1;
        Some(parsed)
    }

    /// Reports that it goes too deep, and skips what does.
    pub fn too_deep(&mut self) {
        let known = self
            .diagnostics
            .last()
            .is_some_and(|last| last.code == Code::TooDeep);
        if !known {
            let problem = Diagnostic::new(Code::TooDeep, self.span(), "this is nested too deeply");
            self.report(problem.note("split it, with `let` or a function"));
        }
        self.skip_line_and_block();
        self.last_error = Some(self.position);
    }

    /// The edits that indent the lines from the one with the byte `from` to the one with the byte before `to`.
    pub fn indent_lines(&self, from: u32, to: u32) -> Vec<Edit> {
        let first = self.start_of_line(from);
        let line_ends = self.text[first as usize..to as usize].match_indices('\n');
        let starts = line_ends
            .map(|(at, _)| first + at as u32 + 1)
            .filter(|start| *start < to);
        core::iter::once(first)
            .chain(starts)
            .map(|start| Edit::new(Span::empty(start), "    "))
            .collect()
    }

    /// The edits that move lines with the bytes `from` to before `to` from the second column to the first, if all of
    /// them are indented that far with spaces.
    pub fn outdent_lines(&self, from: u32, to: u32, columns: (usize, usize)) -> Option<Vec<Edit>> {
        let surplus = columns.1.checked_sub(columns.0)?;
        let mut start = from;
        let mut edits = Vec::new();
        for line in self.text[from as usize..to as usize].split_inclusive('\n') {
            if !line.trim().is_empty() {
                let is_indented = line.bytes().take(surplus).filter(|byte| *byte == b' ');
                if is_indented.count() < surplus {
                    return None;
                }
                edits.push(Edit::new(Span::new(start, start + surplus as u32), ""));
            }
            start += line.len() as u32;
        }
        Some(edits)
    }

    /// Where the line starts that holds the byte at `offset`.
    pub fn start_of_line(&self, offset: u32) -> u32 {
        self.text[..offset as usize]
            .rfind('\n')
            .map_or(0, |at| at as u32 + 1)
    }
}
