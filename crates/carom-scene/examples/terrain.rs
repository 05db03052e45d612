//! Prints the heights of the built-in scene `terrain`, as its file has them: hills and hollows in a valley.
//!
//! `cargo run -p carom-scene --example terrain` writes what stands between the brackets of `heights`.

/// Heights along each side.
const COUNT: usize = 57;
/// Length of a side \[m\].
const SIZE: f64 = 8.0;

/// Hills, and hollows with a negative height: x, z, height and width \[m\].
const HILLS: [[f64; 4]; 10] = [
    [-0.5, -0.7, 1.9, 0.9],
    [2.0, -1.7, 1.2, 0.8],
    [-2.3, 1.1, 1.2, 0.8],
    [1.6, 2.0, 0.9, 0.8],
    [-2.3, -2.2, 0.9, 0.7],
    [-0.4, 2.6, 0.5, 0.6],
    [0.9, 0.5, -0.75, 0.7],
    [-1.1, 1.3, -0.45, 0.5],
    [2.9, 0.4, -0.6, 0.6],
    [0.5, -2.5, -0.6, 0.7],
];

/// Height of the ground at a place \[m\]: a valley that is flat within and steep at its rim, and its hills.
fn height(x: f64, z: f64) -> f64 {
    let rise = |along: f64| {
        let part = 2.0 * along / SIZE;
        let squared = part * part;
        1.5 * squared * squared * squared
    };
    let rim = rise(x) + rise(z);
    let hill = |&[x0, z0, height, width]: &[f64; 4]| {
        let apart = ((x - x0) * (x - x0) + (z - z0) * (z - z0)) / (width * width);
        height / ((1.0 + 0.5 * apart) * (1.0 + 0.5 * apart))
    };
    rim + HILLS.iter().map(hill).sum::<f64>()
}

/// Rows of heights along x, from the lowest z on, as numbers of a scene file.
pub fn rows() -> Vec<String> {
    let place = |number: usize| SIZE * (number as f64 / (COUNT - 1) as f64 - 0.5);
    let row = |row: usize| {
        let heights = (0..COUNT).map(|column| height(place(column), place(row)));
        let numbers: Vec<String> = heights.map(|height| format!("{height:.3}")).collect();
        format!("    [{}],", numbers.join(", "))
    };
    (0..COUNT).map(row).collect()
}

#[allow(dead_code)]
fn main() {
    for row in rows() {
        println!("{row}");
    }
}
