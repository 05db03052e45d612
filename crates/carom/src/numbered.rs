//! Numbers of colliders, forces, springs and emitters.

use educe::Educe;

/// Items that keep their numbers, in the order in which they were added.
#[derive(Debug, Educe)]
#[educe(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Numbered<T> {
    /// Ascending by number.
    items: Vec<(u64, T)>,
    next: u64,
}

impl<T> Default for Numbered<T> {
    fn default() -> Self {
        Self { items: Vec::new(), next: 0 }
    }
}

impl<T> Numbered<T> {
    /// The number that the next one will get.
    pub fn next_number(&self) -> u64 {
        self.next
    }

    pub fn push(&mut self, item: T) {
        self.items.push((self.next, item));
        self.next += 1;
    }

    pub fn get(&self, number: u64) -> Option<&T> {
        self.place(number).map(|place| &self.items[place].1)
    }

    pub fn get_mut(&mut self, number: u64) -> Option<&mut T> {
        self.place(number).map(|place| &mut self.items[place].1)
    }

    pub fn remove(&mut self, number: u64) -> Option<T> {
        self.place(number).map(|place| self.items.remove(place).1)
    }

    /// Keeps those that `stays` holds for.
    pub fn retain(&mut self, mut stays: impl FnMut(&T) -> bool) {
        self.items.retain(|(_, item)| stays(item));
    }

    pub fn iter(&self) -> impl ExactSizeIterator<Item = (u64, &T)> {
        self.items.iter().map(|(number, item)| (*number, item))
    }

    pub fn values_mut(&mut self) -> impl Iterator<Item = &mut T> {
        self.items.iter_mut().map(|(_, item)| item)
    }

    /// Returns the items that `make` makes of these, with the same numbers.
    #[cfg(feature = "serde")]
    pub fn try_map<U, E>(&self, make: impl Fn(&T) -> Result<U, E>) -> Result<Numbered<U>, E> {
        let made = |(number, item)| Ok((number, make(item)?));
        Ok(Numbered { items: self.iter().map(made).collect::<Result<_, E>>()?, next: self.next })
    }

    fn place(&self, number: u64) -> Option<usize> {
        self.items.binary_search_by_key(&number, |item| item.0).ok()
    }
}
