//! Where empty lines are: never two, one around each declaration with a block, none where a block
//! begins, none before a part of something.

use super::line::{Line, Sort};
use super::piece::Declaration;

/// Puts empty lines where they belong.
pub(super) fn arrange(lines: &mut [Line]) {
    for index in 0..lines.len() {
        let opens_block = index > 0 && lines[index].depth > lines[index - 1].depth;
        let line = &mut lines[index];
        if index == 0 || opens_block || matches!(line.sort, Sort::Part | Sort::Continuation) {
            line.blank = false;
        }
    }
    // For each depth the declaration before.
    let mut before: [Option<Declaration>; 2] = [None; 2];
    for index in 0..lines.len() {
        let Some(declaration) = lines[index].starts else {
            continue;
        };
        let depth = lines[index].depth.min(1);
        let last = before[depth].replace(declaration);
        if depth == 0 {
            before[1] = None;
        }
        let is_block = |declaration| declaration == Declaration::Block;
        if last.is_some_and(|last| is_block(last) || is_block(declaration)) {
            let first = first_of(lines, index);
            lines[first].blank = true;
        }
    }
}

/// The first of the comments that are right above a line, or the line.
fn first_of(lines: &[Line], mut index: usize) -> usize {
    let depth = lines[index].depth;
    while index > 0
        && !lines[index].blank
        && lines[index - 1].sort == Sort::Comment
        && lines[index - 1].depth == depth
    {
        index -= 1;
    }
    index
}
