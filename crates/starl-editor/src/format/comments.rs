//! Comments at the end of lines one below the other start in the same column.

use super::line::{Line, Sort};

/// Moves the comments to their columns.
pub(super) fn align(lines: &mut [Line]) {
    let mut start = 0;
    while start < lines.len() {
        let count = lines[start..]
            .iter()
            .take_while(|line| has_comment(line))
            .count();
        // An empty line parts what is above from what is below.
        let below = lines[start..start + count]
            .iter()
            .skip(1)
            .take_while(|line| !line.blank)
            .count();
        let group = &mut lines[start..start + count.min(below + 1)];
        let column = group.iter().map(width).max().unwrap_or(0) + 2;
        for line in group.iter_mut() {
            line.comment_gap = column - width(line);
        }
        start += group.len().max(1);
    }
}

fn has_comment(line: &Line) -> bool {
    line.comment.is_some() && line.sort != Sort::Verbatim
}

fn width(line: &Line) -> usize {
    line.indentation + line.text.chars().count()
}
