//! Configuration file: a user's settings for all calls.

use std::io::ErrorKind;
use std::path::PathBuf;

use serde::Deserialize;

use crate::failure::Failure;

/// Content of the configuration file. The command line and the environment take precedence.
#[derive(Debug, Default, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Config {
    /// Folders with scene files.
    pub scenes: Vec<PathBuf>,
    /// Address of the page that opens links.
    pub page: Option<String>,
    /// Most spheres that a scene file or a link may ask for.
    pub max_spheres: Option<u64>,
    /// Folder for pictures and films of the window.
    pub pictures: Option<PathBuf>,
}

impl Config {
    /// Reads the configuration file, if it exists: the one that $CAROM_CONFIG names, else
    /// `carom/config.toml` in the user's configuration folder.
    pub fn load() -> Result<Self, Failure> {
        let named = std::env::var_os("CAROM_CONFIG").filter(|it| !it.is_empty());
        let is_named = named.is_some();
        let Some(path) = named.map(PathBuf::from).or_else(usual_path) else {
            return Ok(Self::default());
        };
        let text = match std::fs::read_to_string(&path) {
            Ok(text) => text,
            Err(error) if !is_named && error.kind() == ErrorKind::NotFound => {
                return Ok(Self::default());
            }
            Err(error) => {
                return Err(Failure::Usage(format!("cannot read {}: {error}", path.display())));
            }
        };
        Self::read(&text).map_err(|(line, problem)| {
            let line = line.map(|line| format!(":{line}")).unwrap_or_default();
            Failure::Usage(format!("{}{line}: {problem}", path.display()))
        })
    }

    /// Parses the text; an error contains the line, if it is known.
    fn read(text: &str) -> Result<Self, (Option<usize>, String)> {
        toml::from_str(text).map_err(|error| {
            let line = error.span().map(|span| 1 + text[..span.start].matches('\n').count());
            (line, error.message().to_owned())
        })
    }
}

/// Default path of the file.
fn usual_path() -> Option<PathBuf> {
    let folder = |name| std::env::var_os(name).filter(|it| !it.is_empty()).map(PathBuf::from);
    let of_user = || folder("HOME").map(|home| home.join(".config"));
    let configurations =
        folder("XDG_CONFIG_HOME").or_else(|| folder("APPDATA")).or_else(of_user)?;
    Some(configurations.join("carom").join("config.toml"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mistake_is_told_with_its_line() {
        let (line, problem) = Config::read("page = \"x\"\nscnes = []\n").unwrap_err();
        assert_eq!(line, Some(2));
        assert!(problem.contains("scnes") && problem.contains("scenes"), "{problem}");
    }
}
