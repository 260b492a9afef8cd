//! The kinds of picture that files can hold.

use crate::failure::Failure;
use std::path::Path;

/// The kinds of picture.
#[derive(Clone, Copy)]
pub enum Picture {
    Svg,
    #[cfg(feature = "png")]
    Png,
}

impl Picture {
    /// The kind of picture, by the file's name.
    pub fn of(path: &Path) -> Result<Picture, Failure> {
        Picture::given_as(path, "--plot")
    }

    /// The same for a file that another option names.
    pub fn given_as(path: &Path, option: &str) -> Result<Picture, Failure> {
        match path.extension().and_then(|extension| extension.to_str()) {
            Some("svg") => Ok(Picture::Svg),
            #[cfg(feature = "png")]
            Some("png") => Ok(Picture::Png),
            #[cfg(not(feature = "png"))]
            Some("png") => Err(Failure(format!(
                "{option} {}: this build draws no PNG; name a file ending in .svg",
                path.display()
            ))),
            _ => Err(Failure(format!(
                "{option} {}: the name must end in .svg or .png",
                path.display()
            ))),
        }
    }
}
