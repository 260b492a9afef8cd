//! Files as the protocol names them, by URIs.

use lsp_types::Uri;
use std::path::{Path, PathBuf};

/// The file that a URI names; none if it names something else.
pub fn path(uri: &Uri) -> Option<PathBuf> {
    let rest = uri.as_str().strip_prefix("file://")?;
    let start = rest.find('/')?;
    let text = decoded(&rest[start..])?;
    // A drive is named `/C:/`.
    let is_drive = text.as_bytes().get(2) == Some(&b':') && cfg!(windows);
    let text = if is_drive { &text[1..] } else { &text };
    Some(PathBuf::from(text))
}

/// How a file is named; none if its path is not text or not absolute.
pub fn uri(path: &Path) -> Option<Uri> {
    let text = path.to_str().filter(|_| path.is_absolute())?;
    let text = if cfg!(windows) {
        format!("/{}", text.replace('\\', "/"))
    } else {
        text.to_string()
    };
    let mut name = String::from("file://");
    for byte in text.bytes() {
        if byte.is_ascii_alphanumeric() || b"/-_.~".contains(&byte) {
            name.push(char::from(byte));
        } else {
            name.push_str(&format!("%{byte:02X}"));
        }
    }
    name.parse().ok()
}

fn decoded(text: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let Some((first, after)) = rest.split_first() {
        let hexadecimal = after.get(..2).and_then(|digits| {
            let digits = std::str::from_utf8(digits).ok()?;
            u8::from_str_radix(digits, 16).ok()
        });
        match (first, hexadecimal) {
            (b'%', Some(byte)) => {
                bytes.push(byte);
                rest = &after[2..];
            }
            _ => {
                bytes.push(*first);
                rest = after;
            }
        }
    }
    String::from_utf8(bytes).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_is_named_and_found_again() {
        for text in [
            "/a/b.starl",
            "/with space/\u{e4}\u{1f600}%41.starl",
            "/a+b&c#d?e",
        ] {
            let name = uri(Path::new(text)).expect("it has a name");
            assert_eq!(path(&name), Some(PathBuf::from(text)), "{name:?}");
        }
    }

    #[test]
    fn editors_name_a_file_in_several_ways() {
        for text in [
            "file:///a%20b/c.starl",
            "file://localhost/a%20b/c.starl",
            "file:///a%20b/%63.starl",
        ] {
            let name: Uri = text.parse().expect("it is a URI");
            assert_eq!(path(&name), Some(PathBuf::from("/a b/c.starl")), "{text}");
        }
    }

    #[test]
    fn other_uris_have_no_path() {
        for text in [
            "untitled:Untitled-1",
            "starl-library:/prelude.starl",
            "https://a/b",
        ] {
            let name: Uri = text.parse().expect("it is a URI");
            assert_eq!(path(&name), None, "{text}");
        }
        assert_eq!(uri(Path::new("relative.starl")), None);
    }
}
