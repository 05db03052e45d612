//! Which files of C# use types that others declare.

use std::collections::{BTreeMap, HashMap};

use super::Script;
use crate::imports::Import;

/// Words after which a type has its name.
const KINDS: [&str; 4] = ["class", "struct", "enum", "interface"];

/// For each file, those whose types it names, by their places among the scripts. A type in parts
/// belongs to all files that have one of them, so it leads to none.
pub fn imports(scripts: &[Script]) -> Vec<BTreeMap<usize, Import>> {
    let words: Vec<Vec<(usize, String)>> = scripts.iter().map(|it| words(&it.code())).collect();
    let mut declared: HashMap<&str, Option<usize>> = HashMap::new();
    for (place, words) in words.iter().enumerate() {
        for name in words.windows(2).filter(|it| KINDS.contains(&&*it[0].1)).map(|it| &it[1].1) {
            let known = declared.entry(name).or_insert(Some(place));
            *known = known.filter(|known| *known == place);
        }
    }
    let of = |place: usize| {
        let mut found = BTreeMap::new();
        for (line, word) in &words[place] {
            if let Some(&Some(to)) = declared.get(word.as_str())
                && to != place
            {
                found.entry(to).or_insert(Import { path: word.clone(), line: *line });
            }
        }
        found
    };
    (0..scripts.len()).map(of).collect()
}

/// The words of a file, with their lines.
fn words(code: &str) -> Vec<(usize, String)> {
    let of_line = |(number, line): (usize, &str)| {
        let words = line.split(|letter: char| !letter.is_alphanumeric() && letter != '_');
        let words = words.filter(|word| !word.is_empty());
        words.map(|word| (number, word.to_owned())).collect::<Vec<_>>()
    };
    (1..).zip(code.lines()).flat_map(of_line).collect()
}

#[cfg(test)]
mod tests {
    use super::imports;
    use crate::scripts::Script;

    #[test]
    fn a_file_uses_the_types_of_others() {
        let scripts = [
            Script::of_test("a.cs", "class A { B b; } // C\npartial class D {}"),
            Script::of_test("b.cs", "struct B { string s = \"A\"; D d; }"),
            Script::of_test("c.cs", "enum C { A }\npartial class D {}"),
        ];
        let found = imports(&scripts);
        let targets: Vec<Vec<usize>> =
            found.iter().map(|it| it.keys().copied().collect()).collect();
        assert_eq!(targets, [vec![1], vec![], vec![0]]);
    }
}
