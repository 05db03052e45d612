//! The languages besides Rust.

use std::path::Path;

/// A language besides Rust.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Language {
    Python,
    JavaScript,
    CSharp,
}

impl Language {
    /// The language of a file, by its ending.
    pub fn of(file: &Path) -> Option<Self> {
        match file.extension()?.to_str()? {
            "py" | "pyi" => Some(Self::Python),
            // The declarations of TypeScript have its imports.
            "js" | "ts" => Some(Self::JavaScript),
            "cs" => Some(Self::CSharp),
            _ => None,
        }
    }
}
