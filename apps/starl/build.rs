//! Embeds the built page, `playground/dist`, into the command: writes `page.rs`, the list of its files. They are
//! copied first, so that a later build of the page does no harm.

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
    let target = PathBuf::from(var("OUT_DIR").map_err(io::Error::other)?);
    let copy = target.join("page");
    if copy.exists() {
        fs::remove_dir_all(&copy)?;
    }
    let mut list = String::from("&[\n");
    if built.is_dir() {
        println!("cargo::rerun-if-changed={}", built.display());
        embed(&built, "", &copy, &mut list)?;
    } else if playground.is_dir() {
        // A page that is built later makes a change here. Cargo rebuilds each time where it is to watch for
        // something that is not there.
        println!("cargo::rerun-if-changed={}", playground.display());
    }
    list.push(']');
    fs::write(target.join("page.rs"), list)
}

/// Copies and lists the files in a folder and below it, with their paths in the page.
fn embed(folder: &Path, path: &str, copy: &Path, list: &mut String) -> io::Result<()> {
    fs::create_dir_all(copy)?;
    let entries: io::Result<Vec<_>> = fs::read_dir(folder)?.collect();
    let mut entries = entries?;
    entries.sort_by_key(fs::DirEntry::file_name);
    for entry in entries {
        let name = format!("{path}{}", entry.file_name().display());
        if entry.file_type()?.is_dir() {
            let copy = copy.join(entry.file_name());
            embed(&entry.path(), &format!("{name}/"), &copy, list)?;
        } else {
            let file = copy.join(entry.file_name());
            fs::copy(entry.path(), &file)?;
            writeln!(list, "({name:?}, include_bytes!({file:?})),").map_err(io::Error::other)?;
        }
    }
    Ok(())
}
