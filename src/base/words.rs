//! The state that a run remembers between two steps, as words of 64 bits: one list of fields says what is saved and what is loaded.

use std::collections::VecDeque;

/// Words that numbers are saved to, in their order, or loaded from.
#[derive(Debug)]
pub(crate) struct Words {
    list: Vec<u64>,
    /// The next word that is loaded; none where words are saved.
    next: Option<usize>,
    fits: bool,
}

/// Numbers whose words are not as many as were saved of others of their kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Unfit;

/// State that can be saved and loaded, bit by bit.
pub(crate) trait Remembered {
    /// Passes all that is remembered, in one order.
    fn pass(&mut self, words: &mut Words);
}

impl Words {
    /// The words that a value remembers.
    pub fn saved(of: &mut (impl Remembered + ?Sized)) -> Vec<u64> {
        let mut words = Self {
            list: Vec::new(),
            next: None,
            fits: true,
        };
        of.pass(&mut words);
        words.list
    }

    /// Gives something what another of its kind has remembered.
    ///
    /// # Errors
    /// Words are missing or left; what has been loaded is then of no use.
    pub fn load(list: &[u64], into: &mut (impl Remembered + ?Sized)) -> Result<(), Unfit> {
        let mut words = Self {
            list: list.to_vec(),
            next: Some(0),
            fits: true,
        };
        into.pass(&mut words);
        let all = words.next == Some(words.list.len());
        if words.fits && all {
            Ok(())
        } else {
            Err(Unfit)
        }
    }

    /// Whether words are loaded.
    pub fn loads(&self) -> bool {
        self.next.is_some()
    }

    fn word(&mut self, of: u64) -> u64 {
        let Some(next) = &mut self.next else {
            self.list.push(of);
            return of;
        };
        let found = self.list.get(*next).copied();
        *next += 1;
        self.fits &= found.is_some();
        found.unwrap_or(0)
    }

    /// The length of a list; of one that is loaded at most the words that are left.
    fn length(&mut self, of: usize) -> usize {
        let length = self.word(of as u64);
        let left = self
            .next
            .map_or(u64::MAX, |next| self.list.len().saturating_sub(next) as u64);
        self.fits &= length <= left;
        // Fits, since it is at most the length of a list, saved or of words.
        #[allow(clippy::cast_possible_truncation)]
        let length = length.min(left) as usize;
        length
    }
}

/// State that remembers the fields in this list, in its order. What stands behind `but` it is made with. The compiler asks about a
/// field in neither.
macro_rules! remembers {
    ($of:ty: $($field:ident),+ $(; but $($other:ident),+)?) => {
        impl $crate::base::words::Remembered for $of {
            fn pass(&mut self, words: &mut $crate::base::words::Words) {
                let Self { $($field,)+ $($($other: _,)+)? } = self;
                $($crate::base::words::Remembered::pass($field, words);)+
            }
        }
    };
}

pub(crate) use remembers;

impl Remembered for u64 {
    fn pass(&mut self, words: &mut Words) {
        *self = words.word(*self);
    }
}

impl Remembered for f64 {
    fn pass(&mut self, words: &mut Words) {
        *self = Self::from_bits(words.word(self.to_bits()));
    }
}

impl Remembered for usize {
    fn pass(&mut self, words: &mut Words) {
        let word = words.word(*self as u64);
        *self = Self::try_from(word).unwrap_or_default();
    }
}

impl Remembered for i64 {
    fn pass(&mut self, words: &mut Words) {
        *self = words.word(self.cast_unsigned()).cast_signed();
    }
}

impl Remembered for bool {
    fn pass(&mut self, words: &mut Words) {
        *self = words.word(u64::from(*self)) != 0;
    }
}

impl<T: Remembered, const N: usize> Remembered for [T; N] {
    fn pass(&mut self, words: &mut Words) {
        for each in self.iter_mut() {
            each.pass(words);
        }
    }
}

impl<A: Remembered, B: Remembered> Remembered for (A, B) {
    fn pass(&mut self, words: &mut Words) {
        self.0.pass(words);
        self.1.pass(words);
    }
}

impl<T: Remembered + Default> Remembered for Option<T> {
    fn pass(&mut self, words: &mut Words) {
        let mut is_some = self.is_some();
        is_some.pass(words);
        if is_some {
            self.get_or_insert_default().pass(words);
        } else {
            *self = None;
        }
    }
}

impl<T: Remembered + Default + Clone> Remembered for Vec<T> {
    fn pass(&mut self, words: &mut Words) {
        let length = words.length(self.len());
        self.resize(length, T::default());
        for each in self.iter_mut() {
            each.pass(words);
        }
    }
}

impl<T: Remembered + Default + Clone> Remembered for VecDeque<T> {
    fn pass(&mut self, words: &mut Words) {
        let length = words.length(self.len());
        self.resize(length, T::default());
        for each in self.iter_mut() {
            each.pass(words);
        }
    }
}

/// Truth: what was saved.
#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug, Clone, Default, PartialEq)]
    struct Mixture {
        numbers: Vec<f64>,
        maybe: Option<(usize, bool)>,
        signed: i64,
    }

    remembers!(Mixture: numbers, maybe, signed);

    fn kept() -> Mixture {
        Mixture {
            numbers: vec![-0.0, 0.1 + 0.2, f64::NEG_INFINITY, f64::MIN_POSITIVE / 2.0],
            maybe: Some((7, true)),
            signed: -14,
        }
    }

    #[test]
    fn what_is_loaded_is_what_was_saved() {
        let words = Words::saved(&mut kept());
        let mut other = Mixture {
            numbers: vec![1.0; 9],
            ..Mixture::default()
        };
        Words::load(&words, &mut other).unwrap();
        assert_eq!(other, kept());
        assert_eq!(other.numbers[0].to_bits(), (-0.0_f64).to_bits());
    }

    #[test]
    fn words_that_are_missing_left_or_senseless_do_not_fit() {
        let words = Words::saved(&mut kept());
        let mut more = words.clone();
        more.push(0);
        let mut longer = words.clone();
        longer[0] = u64::MAX;
        for wrong in [&words[1..], &words[..3], &more, &longer] {
            assert_eq!(Words::load(wrong, &mut Mixture::default()), Err(Unfit));
        }
    }
}
