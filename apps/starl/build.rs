//! Puts the built page, `playground/dist`, into the command: writes `page.rs`, the list of its files.

use std::env::{var, var_os};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{fs, io};

fn main() -> io::Result<()> {
    println!("cargo::rerun-if-changed=build.rs");
    if var_os("CARGO_FEATURE_WEB").is_none() {
        return Ok(());
    }
    let own = PathBuf::from(var("CARGO_MANIFEST_DIR").map_err(io::Error::other)?);
    let playground = own.join("../../playground");
    let built = playground.join("dist");
    let mut list = String::from("&[\n");
    if built.is_dir() {
        println!("cargo::rerun-if-changed={}", built.display());
        embed(&built.canonicalize()?, "", &mut list)?;
    } else if playground.is_dir() {
        // A page that is built later makes a change here. Cargo rebuilds each time where it is to watch for
        // something that is not there.
        println!("cargo::rerun-if-changed={}", playground.display());
    }
    list.push(']');
    let target = PathBuf::from(var("OUT_DIR").map_err(io::Error::other)?);
    fs::write(target.join("page.rs"), list)
}

/// Lists the files in a folder and below it, with their paths in the page.
fn embed(folder: &Path, path: &str, list: &mut String) -> io::Result<()> {
    let entries: io::Result<Vec<_>> = fs::read_dir(folder)?.collect();
    let mut entries = entries?;
    entries.sort_by_key(fs::DirEntry::file_name);
    for entry in entries {
        let name = format!("{path}{}", entry.file_name().display());
        if entry.file_type()?.is_dir() {
            embed(&entry.path(), &format!("{name}/"), list)?;
        } else {
            let file = entry.path();
            writeln!(list, "({name:?}, include_bytes!({file:?})),").map_err(io::Error::other)?;
        }
    }
    Ok(())
}
