//! The grammar of the language reference is that of the parser: texts that it derives are parsed without an error, and
//! it derives every program of the tests.
#![allow(clippy::disallowed_methods, reason = "a test reads its page")]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;

use crate::common::{parsed, written};
use starl_core::Random;
use starl_lang::syntax::{SyntaxKind, parse};

/// The right side of a production.
#[derive(Debug)]
enum Form {
    /// A literal word or sign.
    Word(String),
    /// A class of words, such as NAME.
    Class(String),
    /// A nonterminal.
    Rule(String),
    Row(Vec<Form>),
    Choice(Vec<Form>),
    /// Any number of times.
    Repeated(Box<Form>),
}

type Grammar = BTreeMap<String, Form>;

/// The productions of the page.
fn grammar() -> Grammar {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../docs/reference/language.md"
    );
    let page = fs::read_to_string(path).expect("the language reference");
    let (_, block) = page.split_once("```ebnf\n").expect("the grammar");
    let (block, _) = block.split_once("```").expect("the end of the grammar");
    let mut grammar = Grammar::new();
    let joined = block.replace("\n ", " ");
    for line in joined.lines().filter(|line| !line.is_empty()) {
        let (name, form) = line.split_once('=').expect("a production");
        let words = signs(form);
        let mut at = 0;
        let form = choice(&words, &mut at);
        assert_eq!(at, words.len(), "{line}");
        grammar.insert(name.trim().into(), form);
    }
    grammar
}

/// The words and signs of a right side.
fn signs(form: &str) -> Vec<String> {
    let mut signs = Vec::new();
    let mut rest = form.trim_start();
    while let Some(first) = rest.chars().next() {
        let length = match first {
            '\'' => rest[1..].find('\'').expect("a closing quote") + 2,
            _ if first.is_ascii_alphabetic() => {
                let end = rest.find(|other: char| !other.is_ascii_alphabetic());
                end.unwrap_or(rest.len())
            }
            _ => 1,
        };
        signs.push(rest[..length].into());
        rest = rest[length..].trim_start();
    }
    signs
}

fn choice(signs: &[String], at: &mut usize) -> Form {
    let mut forms = vec![row(signs, at)];
    while signs.get(*at).is_some_and(|sign| sign == "|") {
        *at += 1;
        forms.push(row(signs, at));
    }
    Form::Choice(forms)
}

fn row(signs: &[String], at: &mut usize) -> Form {
    let mut forms = Vec::new();
    while let Some(sign) = signs
        .get(*at)
        .filter(|sign| !"|)]}".contains(sign.as_str()))
    {
        *at += 1;
        let inner = |at: &mut usize| {
            let form = choice(signs, at);
            *at += 1;
            form
        };
        forms.push(match sign.as_str() {
            "(" => inner(at),
            "[" => Form::Choice(vec![Form::Row(Vec::new()), inner(at)]),
            "{" => Form::Repeated(Box::new(inner(at))),
            word if word.starts_with('\'') => Form::Word(word.trim_matches('\'').into()),
            name if name.starts_with(|first: char| first.is_uppercase()) => {
                Form::Class(name.into())
            }
            name => Form::Rule(name.into()),
        });
    }
    Form::Row(forms)
}

/// Writes random texts that the grammar derives.
struct Writer<'a> {
    grammar: &'a Grammar,
    costs: &'a BTreeMap<&'a str, u32>,
    random: Random,
    /// How many steps may still be taken before the shortest way is preferred.
    left: i32,
    text: String,
    indentation: usize,
}

impl Writer<'_> {
    fn pick(&mut self, count: usize) -> usize {
        self.random.below(count as u32) as usize
    }

    fn write(&mut self, form: &Form) {
        self.left -= 1;
        match form {
            Form::Word(word) => self.put(word),
            Form::Class(class) => self.class(class),
            Form::Rule(name) => {
                let form = self.grammar.get(name);
                self.write(form.unwrap_or_else(|| panic!("there is no production {name}")));
            }
            Form::Row(forms) => forms.iter().for_each(|form| self.write(form)),
            Form::Choice(forms) => {
                let chosen = if self.left > 0 {
                    self.pick(forms.len())
                } else {
                    let costs = forms.iter().map(|form| cost(form, self.costs));
                    costs
                        .enumerate()
                        .min_by_key(|(_, cost)| *cost)
                        .map_or(0, |(at, _)| at)
                };
                self.write(&forms[chosen]);
            }
            Form::Repeated(form) => {
                while self.left > 0 && self.pick(3) > 0 {
                    self.write(form);
                }
            }
        }
    }

    fn put(&mut self, word: &str) {
        if self.text.ends_with('\n') {
            self.text += &" ".repeat(self.indentation);
        }
        self.text += word;
        self.text.push(' ');
    }

    fn class(&mut self, class: &str) {
        let words: &[&str] = match class {
            "NAME" => &["loc", "pick", "target", "motion", "message", "init", "role"],
            "INT" => &["0", "12", "1_000"],
            "FLOAT" => &["1.5", "75mm", "90deg"],
            "DURATION" => &["2s", "500ms"],
            "STRING" => &["\"a\"", "\"\\n{}\""],
            "NEWLINE" => return self.text.push('\n'),
            "INDENT" => return self.indentation += 4,
            "DEDENT" => return self.indentation -= 4,
            _ => panic!("there is no class {class}"),
        };
        let word = words[self.pick(words.len())];
        self.put(word);
    }
}

/// How many words the form takes at least, given that of the productions; as yet unknown ones take many.
fn cost(form: &Form, costs: &BTreeMap<&str, u32>) -> u32 {
    match form {
        Form::Word(_) | Form::Class(_) => 1,
        Form::Rule(name) => costs.get(name.as_str()).copied().unwrap_or(1000),
        Form::Row(forms) => forms.iter().map(|form| cost(form, costs)).sum(),
        Form::Choice(forms) => forms
            .iter()
            .map(|form| cost(form, costs))
            .min()
            .unwrap_or(0),
        Form::Repeated(_) => 0,
    }
}

#[test]
fn derived_texts_are_parsed_without_errors() {
    let grammar = grammar();
    let mut costs = BTreeMap::new();
    for _ in 0..grammar.len() {
        let new = grammar
            .iter()
            .map(|(name, form)| (name.as_str(), cost(form, &costs)));
        costs = new.collect();
    }
    for seed in 0..1000 {
        let mut writer = Writer {
            grammar: &grammar,
            costs: &costs,
            random: Random::keyed(seed, &[1]),
            left: 0,
            text: String::new(),
            indentation: 0,
        };
        writer.write(&Form::Rule("file".into()));
        for _ in 0..10 {
            writer.left = 60;
            writer.write(&Form::Rule("item".into()));
        }
        let parse = parse(&writer.text);
        let text = &writer.text;
        assert!(
            parse.diagnostics().is_empty(),
            "{text}\n{:#?}",
            parse.diagnostics()
        );
    }
}

/// A word of a text as the grammar sees it.
#[derive(Debug)]
enum Seen {
    Word(String),
    Class(&'static str),
}

/// The words of a text, with the beginnings and ends of blocks.
fn words(text: &str) -> Vec<Seen> {
    let parse = parsed(text);
    assert!(parse.diagnostics().is_empty(), "{:?}", parse.diagnostics());
    let tokens = parse.syntax().descendants_with_tokens();
    let mut words = Vec::new();
    let mut levels = vec![0];
    let mut starts_line = true;
    for token in tokens.filter_map(|element| element.into_token()) {
        let kind = token.kind();
        if kind.is_trivia() {
            continue;
        }
        if kind == SyntaxKind::Newline {
            words.push(Seen::Class("NEWLINE"));
            starts_line = true;
            continue;
        }
        if std::mem::take(&mut starts_line) {
            let at = usize::from(token.text_range().start());
            let column = at - text[..at].rfind('\n').map_or(0, |end| end + 1);
            if column > levels[levels.len() - 1] {
                levels.push(column);
                words.push(Seen::Class("INDENT"));
            }
            while column < levels[levels.len() - 1] {
                levels.pop();
                words.push(Seen::Class("DEDENT"));
            }
        }
        words.push(match kind {
            SyntaxKind::IntegerLiteral => Seen::Class("INT"),
            SyntaxKind::FloatLiteral | SyntaxKind::LengthLiteral | SyntaxKind::AngleLiteral => {
                Seen::Class("FLOAT")
            }
            SyntaxKind::DurationLiteral => Seen::Class("DURATION"),
            SyntaxKind::StringLiteral => Seen::Class("STRING"),
            _ => Seen::Word(token.text().into()),
        });
    }
    words.extend(levels[1..].iter().map(|_| Seen::Class("DEDENT")));
    words
}

/// Finds out how far the grammar reaches into words.
struct Reader<'a> {
    grammar: &'a Grammar,
    words: &'a [Seen],
    /// Where what a production makes may end, by its name and where it begins.
    known: BTreeMap<(&'a str, usize), BTreeSet<usize>>,
    furthest: usize,
}

impl<'a> Reader<'a> {
    fn ends(&mut self, form: &'a Form, start: usize) -> BTreeSet<usize> {
        self.furthest = self.furthest.max(start);
        let fits = |fits: bool| BTreeSet::from_iter(fits.then_some(start + 1));
        match form {
            Form::Word(word) => match self.words.get(start) {
                Some(Seen::Word(seen)) => fits(seen == word),
                _ => BTreeSet::new(),
            },
            Form::Class(class) => match self.words.get(start) {
                Some(Seen::Class(seen)) => fits(seen == class),
                Some(Seen::Word(seen)) => fits(class == "NAME" && is_name(seen)),
                None => BTreeSet::new(),
            },
            Form::Rule(name) => {
                if let Some(ends) = self.known.get(&(name.as_str(), start)) {
                    return ends.clone();
                }
                let ends = self.ends(&self.grammar[name], start);
                self.known.insert((name, start), ends.clone());
                ends
            }
            Form::Row(forms) => {
                let mut ends = BTreeSet::from([start]);
                for form in forms {
                    ends = ends
                        .into_iter()
                        .flat_map(|end| self.ends(form, end))
                        .collect();
                }
                ends
            }
            Form::Choice(forms) => forms
                .iter()
                .flat_map(|form| self.ends(form, start))
                .collect(),
            Form::Repeated(form) => {
                let mut all = BTreeSet::from([start]);
                let mut open = vec![start];
                while let Some(at) = open.pop() {
                    open.extend(
                        self.ends(form, at)
                            .into_iter()
                            .filter(|end| all.insert(*end)),
                    );
                }
                all
            }
        }
    }
}

/// Whether the word is a name, as the parser sees it.
fn is_name(word: &str) -> bool {
    let tree = parse(&format!("program P\n\nx: {word}\n")).syntax();
    let mut tokens = tree
        .descendants_with_tokens()
        .filter_map(|part| part.into_token());
    tokens.any(|token| token.text() == word && token.kind() == SyntaxKind::Identifier)
}

#[test]
fn the_grammar_derives_every_parsed_program() {
    let grammar = grammar();
    let page = include_str!("../../../../docs/reference/language.md");
    let blocks = page.split("\n```starl\n").skip(1);
    let blocks = blocks.map(|part| ("the reference", part.split("\n```").next().unwrap_or("")));
    for (name, text) in written().chain(blocks) {
        let text = format!("{text}\n");
        let words = words(&text);
        let mut reader = Reader {
            grammar: &grammar,
            words: &words,
            known: BTreeMap::new(),
            furthest: 0,
        };
        let ends = reader.ends(&grammar["file"], 0);
        let last = reader.furthest;
        let near = &words[last.saturating_sub(10)..(last + 1).min(words.len())];
        assert!(ends.contains(&words.len()), "{name}: not beyond {near:?}");
    }
}

#[test]
fn every_keyword_is_in_the_grammar() {
    let mut found = BTreeSet::new();
    fn collect(form: &Form, found: &mut BTreeSet<String>) {
        match form {
            Form::Word(word) => drop(found.insert(word.clone())),
            Form::Row(forms) | Form::Choice(forms) => {
                forms.iter().for_each(|form| collect(form, found));
            }
            Form::Repeated(form) => collect(form, found),
            Form::Class(_) | Form::Rule(_) => {}
        }
    }
    grammar()
        .values()
        .for_each(|form| collect(form, &mut found));
    let page = include_str!("../../../../docs/reference/language.md");
    let (_, listed) = page.split_once("cannot be names: `").expect("the keywords");
    let (listed, _) = listed.split_once('`').expect("their end");
    let listed: BTreeSet<&str> = listed.split(' ').collect();
    let reserved = found.iter().map(String::as_str);
    let reserved = reserved.filter(|word| word.starts_with(|first: char| first.is_alphabetic()));
    let reserved: BTreeSet<&str> = reserved.filter(|word| !is_name(word)).collect();
    assert_eq!(listed, reserved);
}
