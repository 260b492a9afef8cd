//! Texts that are nearly programs.

use starl_core::Random;

const PIECES: &[&str] = &[
    " ",
    "\n",
    "    ",
    "\t",
    "\r\n",
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    ",",
    ";",
    ":",
    ".",
    "..",
    "...",
    "=",
    "==",
    "!",
    "&&",
    "||",
    "++",
    "/=",
    "\"",
    "'",
    "\\",
    "//",
    "///",
    "/*",
    "*/",
    "#",
    "$",
    "é",
    "≤",
    "\u{a0}",
    "\u{c}",
    "\u{0}",
    "\r",
    "pre",
    "eff",
    "on",
    "if",
    "then",
    "else",
    "elif",
    "for",
    "in",
    "some",
    "not",
    "let",
    "return",
    "forall",
    "enum",
    "program",
    "init",
    "x",
    "1",
    "2 s",
    "5parsec",
    "9223372036854775808",
    "1e999",
    "else if",
    "while",
    "x()",
    "role a",
    "atomic",
];

/// A text with a few random changes.
pub fn mutated(text: &str, seed: u64) -> String {
    let mut random = Random::keyed(seed, &[2]);
    let mut characters: Vec<char> = text.chars().collect();
    for _ in 0..=random.below(4) {
        let at = random.below(characters.len() as u32 + 1) as usize;
        let longest = if random.chance(0.2) { 80 } else { 3 };
        let to = (at + random.below(longest) as usize).min(characters.len());
        match random.below(4) {
            0 => drop(characters.drain(at..to)),
            1 => {
                let copied: Vec<char> = characters[at..to].to_vec();
                let into = random.below(characters.len() as u32 + 1) as usize;
                characters.splice(into..into, copied);
            }
            _ => {
                let piece = PIECES[random.below(PIECES.len() as u32) as usize];
                characters.splice(at..at, piece.chars());
            }
        }
    }
    characters.into_iter().collect()
}

/// A text of random pieces.
pub fn noise(seed: u64) -> String {
    let mut random = Random::keyed(seed, &[3]);
    (0..random.below(60))
        .map(|_| PIECES[random.below(PIECES.len() as u32) as usize])
        .collect()
}
