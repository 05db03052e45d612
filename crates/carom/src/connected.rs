//! Connected sets of items that are numbered from 0.

/// Sets of numbers; the smallest number of a set names it.
#[derive(Debug, Clone)]
pub(crate) struct Connected {
    /// A smaller number of the same set; the smallest one has itself.
    parent: Vec<usize>,
}

impl Connected {
    /// Returns one set for each number below `count`.
    pub fn new(count: usize) -> Self {
        Self { parent: (0..count).collect() }
    }

    /// Joins the sets of two numbers.
    pub fn join(&mut self, first: usize, second: usize) {
        let (a, b) = (self.root_of(first), self.root_of(second));
        self.parent[a.max(b)] = a.min(b);
    }

    /// Returns the smallest number of a set, and shortens the way to it.
    pub fn root_of(&mut self, mut number: usize) -> usize {
        while self.parent[number] != number {
            self.parent[number] = self.parent[self.parent[number]];
            number = self.parent[number];
        }
        number
    }
}
