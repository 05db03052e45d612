//! Addresses of lists in memory, where JavaScript reads them.

/// Returns the address of a list.
pub fn place<T>(list: &[T]) -> usize {
    list.as_ptr() as usize
}

/// Returns the address of a list, unless it is empty.
pub fn place_of_any<T>(list: &[T]) -> Option<usize> {
    (!list.is_empty()).then(|| place(list))
}
