//! The table of a release: archives with sizes, order of crates, and open requirements.

use std::fs;

use super::{files, readiness};
use crate::member;
use crate::shell::Outcome;

/// Prints the table.
pub fn print() -> Outcome {
    let folder = files::folder()?;
    println!("\n{:>11}  {}", "bytes", folder.display());
    for name in files::names()?.iter().map(String::as_str).chain([files::CHECKSUMS]) {
        let path = folder.join(name);
        let bytes = fs::metadata(&path).map_err(|error| format!("{name}: {error}"))?.len();
        println!("{:>11}  {name}", grouped(bytes));
    }
    let members = member::all()?;
    let order = member::in_order_of_publishing(&members)?;
    let order: Vec<&str> = order.iter().map(|it| it.name.as_str()).collect();
    println!("\nCrates are published in this order: {}", order.join(", "));
    let open = readiness::open_points(None)?;
    if !open.is_empty() {
        println!("\nBefore a release, to be done by hand:\n{}", open.join("\n"));
    }
    Ok(())
}

/// Formats a number with a comma before every three digits.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let starts_group = |place: usize| place > 0 && (digits.len() - place).is_multiple_of(3);
    let mut text = String::new();
    for (place, digit) in digits.chars().enumerate() {
        if starts_group(place) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::grouped;

    #[test]
    fn digits_are_grouped_from_the_right() {
        let numbers = [0, 999, 1000, 1_234_567].map(grouped);
        assert_eq!(numbers, ["0", "999", "1,000", "1,234,567"]);
    }
}
