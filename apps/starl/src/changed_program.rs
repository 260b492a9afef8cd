//! A recorded scenario with another text for a robot's program.

use crate::failure::Failure;
use crate::target;
use starl_catalog::Application;
use starl_catalog::disk;
use starl_catalog::language::SUFFIX;
use starl_catalog::programs::Registry;
use starl_catalog::recording;
use starl_core::{FileError, RobotId};
use starl_sim::read::{Inputs, Loader};
use starl_trace::Header;
use std::path::Path;

/// Reads the recorded scenario again with `program` in place of the program of `robot`.
pub fn read(
    trace: &Path,
    header: &Header,
    recorded: &Application,
    robot: RobotId,
    program: &Path,
    registry: &Registry,
) -> Result<Application, Failure> {
    let group = recorded.scenario().fleet.group_of(robot);
    let key = group.map_or("", |(group, _)| &*group.program);
    if !key.ends_with(SUFFIX) {
        return Err(Failure(format!(
            "--program {}: the robot runs {key:?}, which is written in Rust; only a program in the StarL \
             language can be replaced",
            program.display()
        )));
    }
    let inputs = recording::inputs(header).map_err(|what| Failure::file(trace, what))?;
    let changed = Changed {
        text: target::text(program)?,
        path: program,
        key,
        inputs: &inputs,
    };
    starl_catalog::read(&inputs.request, &changed, registry)
        .map_err(|refusal| target::tell(&refusal, |findings| changed.name(&findings.path)))
}

/// The recorded files, with those on disk before them: the program, and libraries beside it.
struct Changed<'a> {
    text: String,
    path: &'a Path,
    /// The name of the program in the scenario.
    key: &'a str,
    inputs: &'a Inputs,
}

impl Changed<'_> {
    /// The name there of a file beside the program.
    fn beside<'p>(&self, path: &'p str) -> Option<&'p str> {
        let folder = self.key.rfind('/').map_or("", |end| &self.key[..=end]);
        path.strip_prefix(folder).filter(|name| !name.contains('/'))
    }

    /// The displayed name of a file.
    fn name(&self, path: &str) -> String {
        let name = match self.beside(path) {
            Some(_) if path == self.key => self.path.to_path_buf(),
            Some(name) if self.path.with_file_name(name).is_file() => {
                self.path.with_file_name(name)
            }
            _ => return path.to_string(),
        };
        name.display().to_string()
    }
}

impl Loader for Changed<'_> {
    fn load(&self, path: &str) -> Result<Vec<u8>, FileError> {
        if path == self.key {
            return Ok(self.text.clone().into_bytes());
        }
        let library = self.beside(path).filter(|name| name.ends_with(SUFFIX));
        let on_disk = library.map(|name| self.path.with_file_name(name));
        match on_disk.filter(|path| path.is_file()) {
            Some(path) => disk::read(&path),
            None => self.inputs.load(path),
        }
    }
}
