//! How long functions of Python, JavaScript and C# are.

use super::{Language, Script};

/// A function, its line, and how many lines of code it has.
#[derive(Debug, PartialEq, Eq)]
pub struct Function {
    pub name: String,
    pub line: usize,
    pub lines: usize,
}

/// Words with which statements begin that look like functions.
const STATEMENTS: [&str; 8] = ["if", "for", "while", "switch", "catch", "using", "lock", "foreach"];
/// Words that stand before what a function of C# is called, and before nothing else that has
/// parameters.
const MODIFIERS: [&str; 5] = ["public", "private", "internal", "protected", "static"];

/// The functions of a script, by the indents that its formatter gives it. Comments, documentation and
/// empty lines do not count.
pub fn functions(script: &Script) -> Vec<Function> {
    let code = script.code();
    let lines: Vec<(usize, &str)> =
        (1..).zip(code.lines()).filter(|it| !it.1.trim().is_empty()).collect();
    let indent = |line: &str| line.len() - line.trim_start().len();
    let mut found = Vec::new();
    for (at, &(number, line)) in lines.iter().enumerate() {
        if let Some(name) = name_of(line.trim(), script.language) {
            let goes_on = |it: &&(usize, &str)| {
                indent(it.1) > indent(line)
                    || indent(it.1) == indent(line) && it.1.trim().starts_with(['{', '}', ')'])
            };
            let length = 1 + lines[at + 1..].iter().take_while(goes_on).count();
            found.push(Function { name: name.to_owned(), line: number, lines: length });
        }
    }
    found
}

/// The name of the function that begins with this line, if one does.
fn name_of(line: &str, language: Language) -> Option<&str> {
    match language {
        Language::Python => {
            let line = line.strip_prefix("async ").unwrap_or(line);
            Some(line.strip_prefix("def ")?.split_once('(')?.0)
        }
        Language::JavaScript => {
            let mut line = line;
            for prefix in
                ["export ", "default ", "static ", "async ", "function", "* ", "get ", "set "]
            {
                line = line.strip_prefix(prefix).unwrap_or(line).trim_start();
            }
            if let Some(bound) = line.strip_prefix("const ").filter(|it| it.ends_with("=> {")) {
                return Some(bound.split_once(' ')?.0);
            }
            let (name, _) = line.split_once('(').filter(|_| line.ends_with(['{', '(']))?;
            let is_name = |letter: char| letter.is_alphanumeric() || "_$#".contains(letter);
            (name.chars().all(is_name) && !STATEMENTS.contains(&name.trim())).then_some(name)
        }
        Language::CSharp => {
            let (before, _) = line.split_once('(').filter(|_| !line.ends_with([';', ',']))?;
            let first = line.split(' ').next()?;
            MODIFIERS.contains(&first).then(|| before.rsplit(' ').next())?
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Function, functions};
    use crate::scripts::Script;

    fn told(file: &str, text: &str) -> Vec<(String, usize, usize)> {
        let told = |it: Function| (it.name, it.line, it.lines);
        functions(&Script::of_test(file, text)).into_iter().map(told).collect()
    }

    #[test]
    fn functions_of_python_are_as_long_as_their_code() {
        let text = "class A:\n    def f(\n        self,\n    ) -> int:\n        \"\"\"Doc.\n\n        More.\n        \
                    \"\"\"\n        # Why.\n        return 1\n\n    async def g(self): ...\n\n\nx = 1\n";
        assert_eq!(told("a.py", text), [("f".to_owned(), 2, 4), ("g".to_owned(), 12, 1)]);
    }

    #[test]
    fn functions_of_javascript_are_found_in_every_form() {
        let text = "export async function f(\n  a,\n) {\n  return a;\n}\nclass A {\n  #g() {\n    if (a) {\n      \
                    b();\n    }\n  }\n}\nconst h = () => {\n  a();\n};\n";
        let expected = [("f".to_owned(), 1, 5), ("#g".to_owned(), 7, 5), ("h".to_owned(), 13, 3)];
        assert_eq!(told("a.js", text), expected);
    }

    #[test]
    fn functions_of_csharp_end_with_their_brace() {
        let text = "public class A\n{\n    public int F(int a)\n    {\n        return a;\n    }\n\n    \
                    private int b = G(1);\n}\n";
        assert_eq!(told("a.cs", text), [("F".to_owned(), 3, 4)]);
    }
}
