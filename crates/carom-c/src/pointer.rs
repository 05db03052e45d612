//! Memory of the program: values, texts and arrays behind pointers. All reads and writes through
//! pointers are in this module.
//!
//! Null is refused. Any other pointer must lead to what the function states, as the top of the
//! header demands. Nothing needs to be aligned.

use std::ffi::{CStr, c_char};
use std::marker::PhantomData;
use std::mem;

use crate::status::{CaromStatus, Failure};

/// Numbers and structures of numbers, for which any bits are a value.
///
/// # Safety
/// Every pattern of bits must be a value of the type, and the type must have no references.
pub(crate) unsafe trait Plain: Copy {}

// SAFETY: a number.
unsafe impl Plain for u8 {}
// SAFETY: a number.
unsafe impl Plain for u32 {}
// SAFETY: a number.
unsafe impl Plain for u64 {}
// SAFETY: a number.
unsafe impl Plain for f32 {}
// SAFETY: a number.
unsafe impl Plain for f64 {}

/// Memory of the program for one value.
pub(crate) struct Out<'a, T> {
    place: *mut T,
    life: PhantomData<&'a mut T>,
}

impl<T: Copy> Out<'_, T> {
    /// Wraps the pointer of a function's parameter `name`.
    ///
    /// # Safety
    /// `place` is null, or can be written to until the call ends.
    pub unsafe fn new(place: *mut T, name: &str) -> Result<Self, Failure> {
        refuse_null(place, name)?;
        Ok(Self { place, life: PhantomData })
    }

    pub fn set(&mut self, value: T) {
        // SAFETY: `new` was promised that the place can be written to.
        unsafe { self.place.write_unaligned(value) }
    }
}

/// Writes a value to a pointer of the program, unless it is null.
///
/// # Safety
/// `place` is null, or can be written to.
pub(crate) unsafe fn tell<T: Copy>(place: *mut T, value: T) {
    if !place.is_null() {
        // SAFETY: the caller promises that it can be written to.
        unsafe { place.write_unaligned(value) }
    }
}

/// Reads the value behind the pointer of a parameter `name`.
///
/// # Safety
/// `place` is null, or can be read.
pub(crate) unsafe fn read<T: Plain>(place: *const T, name: &str) -> Result<T, Failure> {
    refuse_null(place, name)?;
    // SAFETY: the caller promises that it can be read, and any bits are a value.
    Ok(unsafe { place.read_unaligned() })
}

/// Reads a text that ends in a zero.
///
/// # Safety
/// `text` is null, or points to bytes up to a zero, which do not change during `'a`.
pub(crate) unsafe fn text<'a>(text: *const c_char, name: &str) -> Result<&'a str, Failure> {
    refuse_null(text, name)?;
    // SAFETY: the caller promises a zero at the end.
    let text = unsafe { CStr::from_ptr(text) };
    text.to_str().map_err(|_| Failure::new(CaromStatus::Argument, format!("{name} is not UTF-8")))
}

/// Reads texts that end in a zero each.
///
/// # Safety
/// `texts` is null, or points to `count` pointers that [`text`] accepts.
pub(crate) unsafe fn texts<'a>(
    texts: *const *const c_char,
    count: usize,
    name: &str,
) -> Result<Vec<&'a str>, Failure> {
    let layout = Layout::new::<*const c_char>(Strided { stride: 0, count }, 1, name)?;
    layout.refuse_null(texts, name)?;
    let one = |index: usize| {
        // SAFETY: the caller promises `count` pointers.
        let pointer = unsafe { texts.add(index) };
        // SAFETY: it leads to one of these pointers.
        let pointer = unsafe { pointer.read_unaligned() };
        // SAFETY: each is such a text.
        unsafe { text(pointer, name) }
    };
    (0..count).map(one).collect()
}

/// Layout of an array: bytes from one row to the next (0: no gaps), and number of rows.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Strided {
    pub stride: usize,
    pub count: usize,
}

/// Checked layout of an array.
#[derive(Debug, Clone, Copy)]
struct Layout {
    /// Bytes from one row to the next.
    stride: usize,
    count: usize,
    /// Values per row.
    width: usize,
}

impl Layout {
    fn new<T>(array: Strided, width: usize, name: &str) -> Result<Self, Failure> {
        let refused = |problem: String| Failure::new(CaromStatus::Length, problem);
        let Strided { stride, count } = array;
        let row = width * mem::size_of::<T>();
        let stride = if stride == 0 { row } else { stride };
        if stride < row {
            let problem =
                format!("{name}: a row has {row} bytes, more than the stride of {stride}");
            return Err(refused(problem));
        }
        let bytes = stride.checked_mul(count).filter(|&bytes| isize::try_from(bytes).is_ok());
        match bytes {
            Some(_) => Ok(Self { stride, count, width }),
            None => Err(refused(format!("{name}: {count} rows are more than memory holds"))),
        }
    }

    /// Refuses null unless the array has no rows.
    fn refuse_null<T>(&self, first: *const T, name: &str) -> Result<(), Failure> {
        if self.count == 0 { Ok(()) } else { refuse_null(first, name) }
    }

    /// Returns the position of the first value of a row in bytes.
    ///
    /// # Panics
    /// If there is no such row, or if a row does not have `width` values.
    fn offset(&self, row: usize, width: usize) -> usize {
        assert!(row < self.count && width == self.width, "no row {row} of {width} values");
        row * self.stride
    }
}

/// An array of the program that is read: rows of values.
pub(crate) struct Rows<'a, T> {
    first: *const T,
    layout: Layout,
    life: PhantomData<&'a T>,
}

impl<T: Plain> Rows<'_, T> {
    /// Wraps the array of a parameter `name`, with `width` values per row.
    ///
    /// # Safety
    /// `first` is null, or points to an array of this layout that can be read until the call ends.
    pub unsafe fn new(
        first: *const T,
        array: Strided,
        width: usize,
        name: &str,
    ) -> Result<Self, Failure> {
        let layout = Layout::new::<T>(array, width, name)?;
        layout.refuse_null(first, name)?;
        Ok(Self { first, layout, life: PhantomData })
    }

    pub fn count(&self) -> usize {
        self.layout.count
    }

    /// Returns the values of a row.
    pub fn row<const N: usize>(&self, row: usize) -> [T; N] {
        let offset = self.layout.offset(row, N);
        // SAFETY: `new` was promised that the array has this row.
        let place = unsafe { self.first.byte_add(offset) };
        // SAFETY: a row is this many values, one after another, and any bits are values.
        unsafe { place.cast::<[T; N]>().read_unaligned() }
    }

    /// Returns all rows of an array with one value per row.
    pub fn values(&self) -> impl Iterator<Item = T> {
        (0..self.count()).map(|row| self.row::<1>(row)[0])
    }
}

/// An array of the program that is written: rows of values.
pub(crate) struct RowsMut<'a, T> {
    first: *mut T,
    layout: Layout,
    life: PhantomData<&'a mut T>,
}

impl<T: Copy> RowsMut<'_, T> {
    /// Wraps the array of a parameter `name`, with `width` values per row.
    ///
    /// # Safety
    /// `first` is null, or points to an array of this layout that can be written to until the call
    /// ends.
    pub unsafe fn new(
        first: *mut T,
        array: Strided,
        width: usize,
        name: &str,
    ) -> Result<Self, Failure> {
        let layout = Layout::new::<T>(array, width, name)?;
        layout.refuse_null(first, name)?;
        Ok(Self { first, layout, life: PhantomData })
    }

    pub fn count(&self) -> usize {
        self.layout.count
    }

    /// Writes the values of a row; bytes between rows stay unchanged.
    pub fn set_row<const N: usize>(&mut self, row: usize, values: [T; N]) {
        let offset = self.layout.offset(row, N);
        // SAFETY: `new` was promised that the array has this row.
        let place = unsafe { self.first.byte_add(offset) };
        // SAFETY: a row has space for this many values, one after another.
        unsafe { place.cast::<[T; N]>().write_unaligned(values) }
    }
}

/// Memory of the program for a list and its length.
pub(crate) struct Room<'a, T> {
    /// `None` if the program wants only the length.
    rows: Option<RowsMut<'a, T>>,
    length: Out<'a, usize>,
    name: &'static str,
}

impl<T: Copy> Room<'_, T> {
    /// Wraps the memory for a list of a parameter `name`. If `first` is null, only the length is
    /// written.
    ///
    /// # Safety
    /// `first` is null, or points to an array of this layout that can be written to until the call
    /// ends; `length` is null, or can be written to.
    pub unsafe fn new(
        first: *mut T,
        array: Strided,
        length: *mut usize,
        name: &'static str,
    ) -> Result<Self, Failure> {
        // SAFETY: the caller promises that it can be written to.
        let length = unsafe { Out::new(length, "count") }?;
        let rows = match first.is_null() {
            true => None,
            // SAFETY: the caller promises such an array.
            false => Some(unsafe { RowsMut::new(first, array, 1, name) }?),
        };
        Ok(Self { rows, length, name })
    }

    /// Writes a list and its length; only the length if the list does not fit.
    pub fn fill(mut self, list: impl ExactSizeIterator<Item = T>) -> Result<(), Failure> {
        let length = list.len();
        self.length.set(length);
        let Some(rows) = &mut self.rows else { return Ok(()) };
        if rows.count() < length {
            let (name, room) = (self.name, rows.count());
            let problem = format!("{length} {name} do not fit into room for {room}");
            return Err(Failure::new(CaromStatus::Length, problem));
        }
        list.enumerate().for_each(|(row, value)| rows.set_row(row, [value]));
        Ok(())
    }
}

/// Checks that the number of rows is that of the spheres.
pub(crate) fn require_count(name: &str, count: usize, wanted: usize) -> Result<(), Failure> {
    if count == wanted {
        return Ok(());
    }
    let problem = format!("{name}: {count} rows for {wanted} spheres");
    Err(Failure::new(CaromStatus::Length, problem))
}

fn refuse_null<T>(pointer: *const T, name: &str) -> Result<(), Failure> {
    if pointer.is_null() {
        return Err(Failure::new(CaromStatus::Null, format!("{name} is a null pointer")));
    }
    Ok(())
}
