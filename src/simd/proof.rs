//! Checks that the instructions of a set compute what they should. Run once in a process before a set is used, and by the tests at
//! every set that the machine has.

use std::hint::black_box;

use super::isa::{InstructionSet, Task};
use super::lanes::{Counters, LANES, Lanes, Mask};
use super::number::Number;
use super::vector::{Simd, Vector, Wide};

/// Numbers whose sums, products, quotients and roots are exact, so that fused and unfused products agree.
const A: [f64; LANES] = [1.5, -2.0, 3.0, -4.25, 0.0, 6.0, -7.5, 8.0];
const B: [f64; LANES] = [2.0, 4.0, -8.0, 0.5, 1.0, -0.25, 16.0, -1.0];
const C: [f64; LANES] = [-3.0, 5.0, 0.75, 9.0, -2.0, 1.25, 0.5, -6.0];

/// A primitive and whether it was right.
type Verdict = (&'static str, bool);

/// The first primitive that errs at an instruction set, if any.
pub(super) fn wrong_primitive(instructions: InstructionSet) -> Option<&'static str> {
    let first = |verdicts: &[Verdict]| {
        let wrong = verdicts.iter().find(|(_, right)| !right);
        wrong.map(|(name, _)| *name)
    };
    first(&instructions.run_wide(Registers)).or_else(|| first(&instructions.run(Eights)))
}

/// The same bits, where a NaN equals any other.
fn same(found: f64, wanted: f64) -> bool {
    found.to_bits() == wanted.to_bits() || (found.is_nan() && wanted.is_nan())
}

/// Masks of so many lanes, all of them: lane i is true where bit i is set.
fn patterns(lanes: usize) -> impl Iterator<Item = u32> {
    0..1 << lanes
}

fn bit(pattern: u32, lane: usize) -> bool {
    pattern >> lane & 1 == 1
}

/// Primitives of [`Vector`] and its choices.
struct Registers;

impl Wide for Registers {
    type Output = Vec<Verdict>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Vec<Verdict> {
        let mut verdicts = arithmetic(simd);
        verdicts.extend(moves(simd));
        verdicts.extend(choices(simd));
        verdicts
    }
}

#[inline(always)]
fn numbers<S: Simd>(vector: Vector<S>) -> [f64; LANES] {
    let mut numbers = [0.0; LANES];
    vector.store(&mut numbers);
    numbers
}

#[inline(always)]
fn each<S: Simd>(vector: Vector<S>, wanted: impl Fn(usize) -> f64) -> bool {
    let found = numbers(vector);
    (0..Vector::<S>::LANES).all(|i| same(found[i], wanted(i)))
}

#[inline(always)]
fn arithmetic<S: Simd>(simd: S) -> Vec<Verdict> {
    let [a, b, c] = [A, B, C].map(|of| Vector::load(simd, &black_box(of)));
    let none = a.same(f64::NAN);
    let mut sum = a;
    sum += b;
    vec![
        ("add", each(a + b, |i| A[i] + B[i])),
        ("add_assign", each(sum, |i| A[i] + B[i])),
        ("sub", each(a - b, |i| A[i] - B[i])),
        ("mul", each(a * b, |i| A[i] * B[i])),
        ("div", each(a / b, |i| A[i] / B[i])),
        ("neg", each(-a, |i| 0.0 - A[i])),
        ("abs", each(a.abs(), |i| A[i].abs())),
        ("sqrt", each((a * a).sqrt(), |i| A[i].abs())),
        (
            "exponent_and_mantissa",
            each((a * a + 2.0).exponent_and_mantissa().0, |i| {
                (A[i] * A[i] + 2.0).log2().floor()
            }) && each((a * a + 2.0).exponent_and_mantissa().1, |i| {
                let x = A[i] * A[i] + 2.0;
                x / x.log2().floor().exp2()
            }),
        ),
        ("mul_add", each(a.mul_add(b, c), |i| A[i] * B[i] + C[i])),
        ("or_more", each(a.or_more(b), |i| A[i].max(B[i]))),
        ("or_less", each(a.or_less(b), |i| A[i].min(B[i]))),
        ("or_more keeps a NaN", each(none.or_more(b), |_| f64::NAN)),
        ("or_less keeps a NaN", each(none.or_less(b), |_| f64::NAN)),
        (
            "sum",
            a.sum() == A[..Vector::<S>::LANES].iter().sum::<f64>(),
        ),
    ]
}

#[inline(always)]
fn moves<S: Simd>(simd: S) -> Vec<Verdict> {
    let lanes = Vector::<S>::LANES;
    let [a, b] = [A, B].map(|of| Vector::load(simd, &black_box(of)));
    let turned = |i: usize| if i == 0 { B[lanes - 1] } else { A[i - 1] };
    let (registers, rest) = Vector::<S>::split(&A);
    let second: Vec<(usize, usize)> = Vector::<S>::cover(lanes + 1).collect();
    let mut put = Vector::<S>::registers(&B, 1)[0];
    a.put(&mut put);
    vec![
        ("load and store", each(a, |i| A[i])),
        ("all", each(Vector::all(simd, 2.5), |_| 2.5)),
        ("count", each(Vector::count(simd), |i| i as f64)),
        ("map", each(a.map(|x| x + 1.0), |i| A[i] + 1.0)),
        ("first", a.first() == A[0]),
        ("after", each(a.after(b), turned)),
        ("put", each(Vector::of(simd, put), |i| A[i])),
        (
            "split",
            registers.len() * lanes + rest.len() == A.len()
                && each(Vector::of(simd, registers[0]), |i| A[i]),
        ),
        ("cover", second == [(0, 0), (1, lanes - 1)]),
    ]
}

#[inline(always)]
fn choices<S: Simd>(simd: S) -> Vec<Verdict> {
    let lanes = Vector::<S>::LANES;
    let [a, b] = [A, B].map(|of| Vector::load(simd, &black_box(of)));
    let (zero, none) = (a.same(0.0), a.same(f64::NAN));
    // Below 0 where the pattern is set.
    let choice = |pattern: u32| {
        let signs: [f64; LANES] = std::array::from_fn(|i| if bit(pattern, i) { -1.0 } else { 1.0 });
        Vector::load(simd, &black_box(signs)).below(zero)
    };
    let selects = |found: super::Choice<S>, wanted: &dyn Fn(usize) -> bool| {
        found.lanes().eq((0..lanes).filter(|i| wanted(*i)))
    };
    let all = |right: &dyn Fn(u32) -> bool| patterns(lanes).all(right);
    let other = 0b0110_1010;
    vec![
        ("any", all(&|p| choice(p).any() == (p != 0))),
        ("lanes", all(&|p| selects(choice(p), &|i| bit(p, i)))),
        ("not", all(&|p| selects(choice(p).not(), &|i| !bit(p, i)))),
        (
            "and",
            all(&|p| selects(choice(p).and(choice(other)), &|i| bit(p & other, i))),
        ),
        (
            "or",
            all(&|p| selects(choice(p).or(choice(other)), &|i| bit(p | other, i))),
        ),
        (
            "choose",
            all(&|p| {
                each(
                    choice(p).choose(a, b),
                    |i| if bit(p, i) { A[i] } else { B[i] },
                )
            }),
        ),
        (
            "below a NaN",
            !zero.below(none).any() && !none.below(zero).any(),
        ),
    ]
}

/// Primitives of [`Lanes`] and [`Mask`], compiled for an instruction set.
struct Eights;

impl Task for Eights {
    type Output = Vec<Verdict>;

    #[inline(always)]
    fn run<const FMA: bool>(self) -> Vec<Verdict> {
        let [a, b, c] = [A, B, C].map(|of| Lanes::from_slice(&black_box(of)));
        let each = |found: Lanes, wanted: &dyn Fn(usize) -> f64| {
            (0..LANES).all(|i| same(found[i], wanted(i)))
        };
        let mut verdicts = vec![
            ("lanes: add", each(a + b, &|i| A[i] + B[i])),
            ("lanes: sub", each(a - b, &|i| A[i] - B[i])),
            ("lanes: mul", each(a * b, &|i| A[i] * B[i])),
            ("lanes: div", each(a / b, &|i| A[i] / B[i])),
            ("lanes: neg", each(-a, &|i| -A[i])),
            ("lanes: abs", each(a.abs(), &|i| A[i].abs())),
            ("lanes: sqrt", each((a * a).sqrt(), &|i| A[i].abs())),
            (
                "lanes: mul_add",
                each(a.mul_add::<FMA>(b, c), &|i| A[i] * B[i] + C[i]),
            ),
            ("lanes: or_zero", each(a.or_zero(), &|i| A[i].max(0.0))),
            ("lanes: sum", a.sum() == A.iter().sum::<f64>()),
            ("lanes: least", a.least() == -7.5),
            ("lanes: greatest", a.greatest() == 8.0),
        ];
        verdicts.extend(masks(a, b));
        verdicts
    }
}

#[inline(always)]
fn masks(a: Lanes, b: Lanes) -> [Verdict; 8] {
    let none = Lanes::all(f64::NAN);
    let mask = |pattern: u32| {
        let signs = Lanes::from_fn(|i| if bit(pattern, i) { 1.0 } else { -1.0 });
        black_box(signs).above(Lanes::ZERO)
    };
    let selects =
        |found: Mask, wanted: u32| found.lanes().eq((0..LANES).filter(|i| bit(wanted, *i)));
    let all = |right: &dyn Fn(u32) -> bool| patterns(LANES).all(right);
    let counted = |pattern: u32| {
        let mut counters = Counters::default();
        counters.add(mask(pattern), 3);
        counters.total()
    };
    let other = 0b0110_1010;
    [
        ("mask: any", all(&|p| mask(p).any() == (p != 0))),
        ("mask: lanes", all(&|p| selects(mask(p), p))),
        ("mask: not", all(&|p| selects(mask(p).not(), !p))),
        (
            "mask: and",
            all(&|p| selects(mask(p).and(mask(other)), p & other)),
        ),
        (
            "mask: or",
            all(&|p| selects(mask(p).or(mask(other)), p | other)),
        ),
        (
            "mask: choose",
            all(&|p| {
                let found = mask(p).choose(a, b);
                (0..LANES).all(|i| same(found[i], if bit(p, i) { A[i] } else { B[i] }))
            }),
        ),
        ("mask: counters", all(&|p| counted(p) == 3 * p.count_ones())),
        (
            "mask: NaN",
            !none.above(a).any() && !a.above(none).any() && selects(none.is_nan(), 0xff),
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Analytic: every primitive against the same on single numbers, masks of every pattern, at every instruction set of this
    /// machine. `tests/reliability/levels.rs` prints which levels are missing.
    #[test]
    fn every_primitive_at_every_level() {
        for instructions in InstructionSet::available() {
            println!("{instructions}");
            assert_eq!(wrong_primitive(instructions), None, "{instructions}");
        }
    }
}
