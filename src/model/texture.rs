//! Waves of surfaces as they act in contacts: averaged over the contact, and texture drawn from its seed
//! ([*Defects*](crate::equations#defects)).

use std::f64::consts::TAU;

use realfft::RealFftPlanner;

use super::{Model, Race};
use crate::base::error::{Error, Result};
use crate::base::memory;
use crate::contact::{HeightTable, Pair, Waves};
use crate::scene::{Row, Texture, Waviness};

/// Shortest wave that a texture may have, over the half-width of its contact: shorter ones average out in the contact.
const SHORTEST: f64 = 0.25;

impl Model {
    /// Gives races their waves and texture, averaged over contacts under loads \[N\] by row and race.
    ///
    /// # Errors
    /// [`Error::Scene`] for orders that average out in a contact, [`Error::Memory`] for tables that do not fit.
    pub(crate) fn give_waves(&mut self, loads: &[[f64; 2]]) -> Result<()> {
        let mut planner = RealFftPlanner::new();
        for (row, loads) in loads.iter().enumerate() {
            let scene = self.scene.rows[row].clone();
            if !scene.is_wavy() {
                continue;
            }
            let widths = Race::BOTH.map(|race| self.half_width(row, race, loads[race]));
            if scene.texture.is_some() {
                self.rows[row].texture_widths = Some(widths);
            }
            if let Some(texture) = &scene.texture {
                self.give_ball_texture(row, texture, widths, &mut planner)?;
            }
            for race in Race::BOTH {
                let arc = widths[race] / self.contact_radius(row, race);
                let waves = waves(row, &scene, race, arc, &mut planner)?;
                self.rows[row].pairs[race].change(|flank| flank.waves.clone_from(&waves));
            }
        }
        Ok(())
    }

    /// Gives balls their texture, one table each that both races meet, averaged over the wider of the two contacts.
    fn give_ball_texture(
        &mut self,
        row: usize,
        texture: &Texture,
        widths: [f64; 2],
        planner: &mut RealFftPlanner<f64>,
    ) -> Result<()> {
        if texture.ball == 0.0 {
            return Ok(());
        }
        let arc = self.ball_arc(row, widths);
        let [first, last] = texture.orders_on_ball(arc);
        check_memory(last, self.rows[row].count)?;
        for ball in &mut self.balls[self.rows[row].balls()] {
            let draw = Draw::new(texture.seed, [row as u64, 2, ball.index as u64]);
            let waves = (first..=last).map(|order| draw.wave(texture, texture.ball, order));
            let waves: Vec<_> = waves.map(|wave| averaged_over(wave, arc)).collect();
            ball.side.waves = Waves::tabulated(HeightTable::new(&waves, planner));
        }
        Ok(())
    }

    /// Half-width of the wider contact of a row's balls over their radius.
    pub(crate) fn ball_arc(&self, row: usize, [outer, inner]: [f64; 2]) -> f64 {
        outer.max(inner) / (self.scene.rows[row].ball_diameter / 2.0)
    }

    /// Half-width b along a race of a contact under a load, at least that which films have too \[m\].
    fn half_width(&self, row: usize, race: Race, load: f64) -> f64 {
        let (compiled, scene) = (&self.rows[row], &self.scene.rows[row]);
        let geometry = self.film_race(scene, race, compiled.pairs[race].race.r);
        compiled.hertz[race].half_width * load.max(geometry.least_load()).cbrt()
    }

    /// Radius of a race where its contacts nominally run \[m\].
    pub(crate) fn contact_radius(&self, row: usize, race: Race) -> f64 {
        let torus = &self.rows[row].pairs[race].race;
        torus.a + race.sigma() * torus.r * self.scene.rows[row].contact_angle.cos()
    }

    /// Gives pits the widths of contacts under the typical load.
    pub(crate) fn widen_pits(&mut self) {
        for row in 0..self.rows.len() {
            let widths = self.typical_widths(row);
            for race in Race::BOTH {
                let widen = |flank: &mut Pair| {
                    flank
                        .defects
                        .iter_mut()
                        .for_each(|defect| defect.widen(widths[race]));
                };
                self.rows[row].pairs[race].change(widen);
            }
            let wider = widths[0].max(widths[1]);
            let balls = self.rows[row].balls();
            let defects = self.balls[balls]
                .iter_mut()
                .flat_map(|ball| &mut ball.side.defects);
            defects.for_each(|defect| defect.widen(wider));
        }
    }

    /// Half-widths of a row's contacts with both races under the typical load \[m\].
    pub(crate) fn typical_widths(&self, row: usize) -> [f64; 2] {
        let root = self.scales.load.cbrt();
        self.rows[row].hertz.map(|hertz| hertz.half_width * root)
    }

    /// Mean surface speed at contacts of balls that roll, at the rings' largest speed against each other \[m/s\].
    pub(crate) fn rolling_speed(&self, row: usize) -> f64 {
        let groove = self.rows[row].pairs[Race::Outer].race.r;
        let race = self.film_race(&self.scene.rows[row], Race::Outer, groove);
        race.entrainment(self.scene.peak_relative_speed())
    }

    /// Shortest time in which a ball rolls over a quarter of the half-width of a contact with texture, or of a pit or its contact
    /// \[s\]: what steps must resolve; infinite without texture and pits.
    pub(crate) fn shortest_pass(&self) -> f64 {
        let textures = (0..self.rows.len()).filter_map(|row| {
            let [outer, inner] = self.rows[row].texture_widths?;
            Some(outer.min(inner) / (4.0 * self.rolling_speed(row)))
        });
        let pits = self.scene.defects.values().filter_map(|defect| {
            // One without a size is healthy.
            let finest = defect.damage.finest().filter(|of| *of > 0.0)?;
            let [outer, inner] = self.typical_widths(defect.row);
            let least = outer.min(inner).min(finest);
            Some(least / (4.0 * self.rolling_speed(defect.row)))
        });
        textures.chain(pits).fold(f64::INFINITY, f64::min)
    }
}

/// The waves of a race whose contacts' half-width is so much of its radius.
fn waves(
    index: usize,
    row: &Row,
    race: Race,
    arc: f64,
    planner: &mut RealFftPlanner<f64>,
) -> Result<Waves> {
    let listed = match race {
        Race::Outer => &row.outer_waviness,
        Race::Inner => &row.inner_waviness,
    };
    let mut all = listed.clone();
    let drawn = row.texture.as_ref().map(|texture| {
        let amplitude = match race {
            Race::Outer => texture.outer,
            Race::Inner => texture.inner,
        };
        (texture, amplitude)
    });
    let drawn = drawn.filter(|(_, amplitude)| *amplitude > 0.0);
    if let Some((texture, amplitude)) = drawn {
        check_orders(index, texture, arc)?;
        let draw = Draw::new(texture.seed, [index as u64, race as u64, 0]);
        let [first, last] = texture.orders_on(arc);
        all.extend((first..=last).map(|order| draw.wave(texture, amplitude, order)));
    }
    let averaged: Vec<_> = all
        .into_iter()
        .map(|wave| averaged_over(wave, arc))
        .collect();
    if drawn.is_none() {
        return Ok(Waves::of(averaged));
    }
    let highest = averaged.iter().map(|wave| wave.order).max();
    check_memory(highest.unwrap_or_default(), 1)?;
    Ok(Waves::tabulated(HeightTable::new(&averaged, planner)))
}

/// A wave averaged over contacts, whose half-width is given over the radius.
fn averaged_over(mut wave: Waviness, arc: f64) -> Waviness {
    wave.amplitude *= averaged(f64::from(wave.order) * arc);
    wave
}

/// sin κ/κ: the share of a wave that a contact keeps, κ = n b/R (14.1).
fn averaged(kappa: f64) -> f64 {
    if kappa == 0.0 {
        1.0
    } else {
        kappa.sin() / kappa
    }
}

/// Refuses orders whose waves average out in a contact.
fn check_orders(row: usize, texture: &Texture, arc: f64) -> Result<()> {
    let most = TAU / (SHORTEST * arc);
    let [first, last] = texture.orders_on(arc);
    if f64::from(last) <= most {
        return Ok(());
    }
    Err(Error::scene(
        format!("rows[{row}].texture.orders"),
        format!("[{first}, {last}]"),
        format!(
            "at most {} here: waves shorter than a quarter of a contact's half-width average out in it",
            most.floor()
        ),
    ))
}

/// Refuses tables up to an order that do not fit into memory.
fn check_memory(last: u32, count: usize) -> Result<()> {
    // The table, and what its transform takes.
    let knots = HeightTable::knots_for(last) as f64;
    memory::check(8.0 * knots * (3.0 + count as f64), || {
        format!("{count} tables of a texture up to order {last}; lower its highest order")
    })
}

/// Random numbers of a surface that are found by their numbers, so that more orders, balls or threads change none of them.
pub(super) struct Draw(u64);

impl Draw {
    /// The random numbers of a seed, and of row, body (0 outer race, 1 inner race, 2 ball, 3 cage) and ball.
    pub(super) fn new(seed: u64, of: [u64; 3]) -> Self {
        Self(of.into_iter().fold(mixed(seed), |z, x| mixed(z ^ x)))
    }

    /// The wave of an order, before contacts average it (14.2).
    fn wave(&self, texture: &Texture, amplitude: f64, order: u32) -> Waviness {
        let (phase, size) = self.of(order);
        Waviness::new(
            order,
            size * texture.amplitude(amplitude, order),
            TAU * phase,
        )
    }

    /// u and √(−ln v) of an order: a phase in turns, and an amplitude after Rayleigh.
    pub(super) fn of(&self, order: u32) -> (f64, f64) {
        let z = mixed(self.0 ^ u64::from(order));
        let [u, v] = [0, 1].map(|part| mixed(z ^ part) >> 11);
        let scale = 2_f64.powi(-53);
        (u as f64 * scale, (-((v as f64 + 0.5) * scale).ln()).sqrt())
    }
}

/// A step of `SplitMix64` (G. L. Steele, D. Lea, C. H. Flood, OOPSLA 2014).
fn mixed(x: u64) -> u64 {
    let z = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// The truth is the formulas above, and sums of cosines.
#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_those_of_the_model() {
        assert_eq!(mixed(0), 0xe220_a839_7b1d_cdaf);
        for (seed, of, order, u, size) in [
            (7, [0, 0, 0], 30, 0.253_347_769, 0.628_807_435),
            (7, [0, 1, 0], 2, 0.002_525_560, 1.139_495_475),
            (7, [0, 2, 3], 5, 0.278_392_774, 1.086_559_991),
            ((1 << 40) + 1, [1, 0, 0], 838, 0.283_977_429, 0.439_158_659),
        ] {
            let found = Draw::new(seed, of).of(order);
            assert!(
                (found.0 - u).abs() < 1e-9 && (found.1 - size).abs() < 1e-9,
                "{found:?}"
            );
        }
    }

    /// The outer race of a 6205 under 250 N with seed 7: b 0.115654 mm, R 23.49 mm.
    fn reference() -> Vec<Waviness> {
        let arc = 0.115_654e-3 / 23.49e-3;
        let texture = Texture {
            seed: 7,
            ..Texture::of_races(1e-9)
        };
        assert_eq!(texture.orders_on(arc), [2, 1276]);
        let draw = Draw::new(7, [0, 0, 0]);
        let waves = (2..=1276).map(|order| draw.wave(&texture, 1e-9, order));
        waves.map(|wave| averaged_over(wave, arc)).collect()
    }

    #[test]
    fn heights_are_those_of_the_model() {
        let waves = reference();
        let (sum, table) = (
            Waves::of(waves.clone()),
            HeightTable::new(&waves, &mut RealFftPlanner::new()),
        );
        for (angle, height, slope) in [
            (0.0, -22.4513, -62.668),
            (1.0, 164.7225, 360.309),
            (-2.5, 88.5474, -76.161),
        ] {
            let exact = sum.raise(angle);
            assert!(
                (1e9 * exact.height / height - 1.0).abs() < 1e-5,
                "{exact:?}"
            );
            assert!((1e9 * exact.slope / slope - 1.0).abs() < 1e-5, "{exact:?}");
            let found = table.raise(angle);
            // Shares of the shortest waves, of 3e-4 nm.
            assert!(
                (found.height - exact.height).abs() < 1e-15,
                "{found:?} {exact:?}"
            );
            assert!(
                (found.slope - exact.slope).abs() < 5e-12,
                "{found:?} {exact:?}"
            );
        }
    }

    /// Analytic: one wave at N/n knots a period, everywhere: errors of (2π n/N)⁴/384 in height and (2π n/N)³/125 n in slope, and a tenth
    /// more by their next terms; and the slope as the height's.
    #[test]
    fn a_table_is_as_good_as_its_knots_are_many() {
        for (order, height, slope) in [
            (85, 2.1e-4, 1.25e-3),
            (64, 7e-5, 5e-4),
            (43, 2.5e-5, 2.5e-4),
        ] {
            let wave = vec![Waviness::new(order, 1.0, 0.3), Waviness::new(85, 0.0, 0.0)];
            let table = HeightTable::new(&wave, &mut RealFftPlanner::new());
            let exact = Waves::of(wave);
            let mut worst = [0.0_f64; 3];
            for k in 0..5000 {
                let angle = 0.01 * f64::from(k) - 20.0;
                let (a, b) = (exact.raise(angle), table.raise(angle));
                let n = f64::from(order);
                let rate =
                    (table.raise(angle + 1e-6).height - table.raise(angle - 1e-6).height) / 2e-6;
                let off = [
                    a.height - b.height,
                    (a.slope - b.slope) / n,
                    (rate - b.slope) / n,
                ];
                worst = [0, 1, 2].map(|i| worst[i].max(f64::abs(off[i])));
                let bend = (exact.bend(angle) - table.bend(angle)).abs() / (n * n);
                assert!(bend < 0.03, "{bend}");
            }
            assert!(
                worst[0] < height && worst[1] < slope && worst[2] < 1e-8,
                "{order}: {worst:?}"
            );
        }
    }

    /// Heights of 4000 seeds at one place: mean square Σ A_n² T_n²/2 and a kurtosis of 3, as of a Gaussian surface.
    #[test]
    fn heights_are_gaussian() {
        let (arc, texture) = (5e-3, Texture::of_races(1e-9));
        let [mut squares, mut fourths] = [0.0; 2];
        for seed in 0..4000 {
            let draw = Draw::new(seed, [0, 1, 0]);
            let mut height = 0.0;
            for order in 2..=1256 {
                let wave = averaged_over(draw.wave(&texture, 1e9, order), arc);
                height += wave.amplitude * (f64::from(order) * 0.7 + wave.phase).cos();
            }
            squares += height * height / 4000.0;
            fourths += height.powi(4) / 4000.0;
        }
        let [first, last] = texture.orders_on(arc);
        let of = |n: u32| (texture.amplitude(1e9, n) * averaged(f64::from(n) * arc)).powi(2) / 2.0;
        let expected: f64 = (first..=last).map(of).sum();
        assert!(
            (squares / expected - 1.0).abs() < 0.07,
            "{squares} {expected}"
        );
        let kurtosis = fourths / (squares * squares);
        assert!((kurtosis - 3.0).abs() < 0.3, "{kurtosis}");
    }
}
