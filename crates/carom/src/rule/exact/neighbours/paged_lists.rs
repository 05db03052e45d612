//! Short lists, many of them, each in one piece of memory as long as it fits there.

use std::ops::Range;

use educe::Educe;
use prefetch_index::prefetch_index;

/// A part of a list.
#[derive(Debug, Clone, Copy)]
#[repr(align(8))]
struct Page<T, const SIZE: usize> {
    members: [T; SIZE],
    /// How many members there are, and the number of the next page.
    link: Link,
}

/// Four bits of length, and the number of a page; 0 is none, for there a list begins.
#[derive(Debug, Clone, Copy, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Link(u32);

const LEN_BITS: u32 = 4;

impl Link {
    #[inline(always)]
    fn len(self) -> usize {
        (self.0 & ((1 << LEN_BITS) - 1)) as usize
    }

    fn set_len(&mut self, len: usize) {
        self.0 = self.0 >> LEN_BITS << LEN_BITS | len as u32;
    }

    #[inline(always)]
    fn next(self) -> Option<usize> {
        let next = self.0 >> LEN_BITS;
        (next > 0).then_some(next as usize)
    }

    fn set_next(&mut self, next: Option<usize>) {
        self.0 = self.len() as u32 | (next.unwrap_or(0) as u32) << LEN_BITS;
    }
}

/// Lists by number, unordered, in pages of `SIZE` entries (at most 15).
#[derive(Debug, Educe, Default)]
#[educe(Clone)]
pub(super) struct PagedLists<T, const SIZE: usize> {
    /// The first page of each list, by its number, and behind them the others.
    pages: Vec<Page<T, SIZE>>,
    /// Unused pages.
    spare: Vec<u32>,
}

impl<T: Copy + Default, const SIZE: usize> Page<T, SIZE> {
    fn empty() -> Self {
        Self { members: [T::default(); SIZE], link: Link::default() }
    }
}

impl<T: Copy + PartialEq + Default, const SIZE: usize> PagedLists<T, SIZE> {
    /// Creates `count` empty lists, with room for one more page for every second list. Unused room takes no memory,
    /// whereas growing would double all of it for a moment.
    pub fn new(count: usize) -> Self {
        let mut pages = Vec::with_capacity(count + count / 2);
        pages.resize(count, Page::empty());
        Self { pages, spare: Vec::new() }
    }

    /// Number of members that the first pages of a number of lists hold.
    #[inline(always)]
    pub fn room(&self, lists: usize) -> usize {
        lists * SIZE
    }

    /// Copies the members on the first pages of lists into `members`, from `end` on. Returns where they end and
    /// whether there are further pages. Entries behind the end are unused.
    #[inline(always)]
    pub fn copy_first(
        &self,
        lists: Range<usize>,
        members: &mut [T],
        mut end: usize,
    ) -> (usize, bool) {
        let mut links = 0;
        for page in &self.pages[lists] {
            // Always a whole page: the processor cannot predict how many there are.
            members[end..end + SIZE].copy_from_slice(&page.members);
            end += page.link.len();
            links |= page.link.0;
        }
        (end, Link(links).next().is_some())
    }

    /// Copies the members on the further pages.
    pub fn copy_rest(&self, lists: Range<usize>, members: &mut Vec<T>, mut end: usize) -> usize {
        for mut page in &self.pages[lists] {
            while let Some(next) = page.link.next() {
                page = &self.pages[next];
                let most = end + SIZE;
                if members.len() < most {
                    members.resize(most, T::default());
                }
                members[end..most].copy_from_slice(&page.members);
                end += page.link.len();
            }
        }
        end
    }

    /// Copies the members of a list into `members`, from `len` on. Returns where they end; entries behind that are
    /// unused.
    #[inline(always)]
    pub fn gather(&self, list: usize, members: &mut Vec<T>, len: usize) -> usize {
        if members.len() < len + SIZE {
            members.resize(len + SIZE, T::default());
        }
        match self.copy_first(list..list + 1, members, len) {
            (end, false) => end,
            (end, true) => self.copy_rest(list..list + 1, members, end),
        }
    }

    /// The first members of a list.
    #[inline]
    pub fn first(&self, list: usize) -> &[T] {
        let page = &self.pages[list];
        &page.members[..page.link.len()]
    }

    /// Prefetches the first page of a list into the cache, from its beginning to its end: that may be
    /// two lines.
    #[inline(always)]
    pub fn prefetch(&self, list: usize) {
        prefetch_index(&self.pages, list);
        prefetch_index(&self.pages, list + 1);
    }

    /// The first page of a list: its first members, and behind them former ones.
    #[inline(always)]
    pub fn first_page(&self, list: usize) -> &[T; SIZE] {
        &self.pages[list].members
    }

    /// The members of a list.
    pub fn members(&self, list: usize) -> Vec<T> {
        let mut members = Vec::new();
        let end = self.gather(list, &mut members, 0);
        members.truncate(end);
        members
    }

    /// Replaces the members of a list.
    pub fn set(&mut self, list: usize, members: &[T]) {
        let mut number = list;
        let mut rest = members;
        loop {
            let (now, later) = rest.split_at(rest.len().min(SIZE));
            let page = &mut self.pages[number];
            page.members[..now.len()].copy_from_slice(now);
            page.link.set_len(now.len());
            rest = later;
            if rest.is_empty() {
                break;
            }
            number = self.page_after(number);
        }
        self.cut_after(number);
    }

    pub fn add(&mut self, list: usize, member: T) {
        let mut number = list;
        while self.pages[number].link.len() == SIZE {
            number = self.page_after(number);
        }
        let page = &mut self.pages[number];
        let len = page.link.len();
        page.members[len] = member;
        page.link.set_len(len + 1);
    }

    /// Removes a member from a list, if it is there.
    pub fn remove(&mut self, list: usize, member: T) {
        let Some((number, place, before)) = self.find(list, member) else { return };
        let page = &mut self.pages[number];
        let last = page.link.len() - 1;
        page.members[place] = page.members[last];
        page.link.set_len(last);
        if last == 0 && number != list {
            let next = page.link.next();
            self.pages[before].link.set_next(next);
            self.spare.push(number as u32);
        }
    }

    /// Replaces a member by another, if it is there.
    pub fn replace(&mut self, list: usize, old: T, new: T) {
        if let Some((number, place, _)) = self.find(list, old) {
            self.pages[number].members[place] = new;
        }
    }

    /// Page and place of a member, and the page before that one; the first is before itself.
    fn find(&self, list: usize, member: T) -> Option<(usize, usize, usize)> {
        let (mut number, mut before) = (list, list);
        loop {
            let page = &self.pages[number];
            let there = &page.members[..page.link.len()];
            if let Some(place) = there.iter().position(|&other| other == member) {
                return Some((number, place, before));
            }
            (before, number) = (number, page.link.next()?);
        }
    }

    /// The page after one, or a new one.
    fn page_after(&mut self, number: usize) -> usize {
        if let Some(next) = self.pages[number].link.next() {
            return next;
        }
        let next = match self.spare.pop() {
            Some(next) => {
                self.pages[next as usize] = Page::empty();
                next as usize
            }
            None => {
                self.pages.push(Page::empty());
                self.pages.len() - 1
            }
        };
        self.pages[number].link.set_next(Some(next));
        next
    }

    /// Frees the pages after one.
    fn cut_after(&mut self, number: usize) {
        let mut next = self.pages[number].link.next();
        self.pages[number].link.set_next(None);
        while let Some(page) = next {
            self.spare.push(page as u32);
            next = self.pages[page].link.next();
        }
    }
}

#[cfg(test)]
mod tests {
    //! PagedLists against plain vectors: proves that members come and go singly, whatever the length of
    //! the list; not that pages are used again.

    use super::*;

    #[test]
    fn members_come_and_go_as_in_a_plain_list() {
        let mut lists: PagedLists<u32, 3> = PagedLists::new(3);
        let mut plain = vec![Vec::new(); 3];
        let mut seed = 1u32;
        let mut random = |below: u32| {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (seed >> 16) % below
        };
        for round in 0..4000 {
            let list = random(3) as usize;
            match random(9) {
                0..4 => {
                    lists.add(list, round);
                    plain[list].push(round);
                }
                4..8 if !plain[list].is_empty() => {
                    let place = random(plain[list].len() as u32) as usize;
                    lists.remove(list, plain[list].swap_remove(place));
                    lists.remove(list, u32::MAX);
                }
                _ if round % 16 == 0 => {
                    plain[list] = (round..round + random(40)).collect();
                    lists.set(list, &plain[list]);
                }
                _ => {}
            }
            let mut found = vec![1];
            let end = lists.gather(list, &mut found, 1);
            found.truncate(end);
            assert_eq!(found.remove(0), 1);
            found.sort_unstable();
            let mut members = lists.members(list);
            members.sort_unstable();
            assert_eq!(members, found);
            plain[list].sort_unstable();
            assert_eq!(found, plain[list]);
        }
    }
}

/// Lists as they are written: links, and the members of all pages one after another.
#[cfg(feature = "serde")]
mod written {
    use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

    use super::{Link, Page, PagedLists};

    impl<T: Serialize, const SIZE: usize> Serialize for PagedLists<T, SIZE> {
        fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            let links: Vec<Link> = self.pages.iter().map(|page| page.link).collect();
            let members: Vec<&T> = self.pages.iter().flat_map(|page| &page.members).collect();
            (links, members, &self.spare).serialize(serializer)
        }
    }

    impl<'de, T: Copy + Deserialize<'de>, const SIZE: usize> Deserialize<'de> for PagedLists<T, SIZE> {
        fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
            let (links, members, spare): (Vec<Link>, Vec<T>, _) =
                Deserialize::deserialize(deserializer)?;
            let page = |(members, link): (&[T], Link)| {
                Ok(Page { members: members.try_into().map_err(de::Error::custom)?, link })
            };
            let pages: Vec<_> =
                members.chunks_exact(SIZE).zip(links).map(page).collect::<Result<_, D::Error>>()?;
            Ok(Self { pages, spare })
        }
    }
}
