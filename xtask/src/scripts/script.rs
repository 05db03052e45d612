//! A source file in a language besides Rust.

use std::path::PathBuf;

use super::code;
use super::language::Language;

/// A source file.
pub struct Script {
    /// File of the script, seen from the root of the repository.
    pub file: PathBuf,
    pub language: Language,
    pub text: String,
}

impl Script {
    /// Whether it tests others.
    pub fn is_test(&self) -> bool {
        self.file.iter().any(|name| name == "tests")
    }

    /// Returns the text without comments; in Python and C# also without the content of strings.
    pub fn code(&self) -> String {
        code::of(&self.text, self.language)
    }

    #[cfg(test)]
    pub fn of_test(file: &str, text: &str) -> Self {
        let file = PathBuf::from(file);
        let language = Language::of(&file).unwrap();
        Self { file, language, text: text.to_owned() }
    }
}
