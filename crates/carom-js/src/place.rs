//! Where lists lie in memory: JavaScript looks at them there.

/// Where a list lies.
pub fn place<T>(list: &[T]) -> usize {
    list.as_ptr() as usize
}

/// Where a list lies that holds anything.
pub fn place_of_any<T>(list: &[T]) -> Option<usize> {
    (!list.is_empty()).then(|| place(list))
}
