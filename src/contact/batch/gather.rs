//! Eight contacts side by side: which of them touch, and the data gathered for those that do.

use crate::contact::damage::AngularReach;
use crate::contact::profile::{HeightTable, Raise, Section};
use crate::contact::{FilmNumbers, Motion, Pair};
use crate::simd::{LANES, Lanes, Mask, direction};

/// Positions of eight balls of one row, for [`Pair::near`].
#[derive(Debug, Clone, Copy)]
pub(crate) struct Places<'a> {
    /// Ball radius \[m\].
    pub radius: Lanes,
    /// x, y, z \[m\].
    pub q: [Lanes; 3],
    /// Textures of the balls, where they have any, and how far they have turned \[rad\].
    pub texture: Option<([&'a HeightTable; LANES], Lanes)>,
}

/// Lanes of eight balls of a row that touch a race, those that may see a defect of it or are for other reasons left to
/// [`Pair::evaluate`], how race and balls are raised there, and which balls are lost ([`crate::contact::Torus::farthest`]).
#[derive(Debug, Clone, Copy)]
pub(crate) struct Near {
    pub touching: Mask,
    pub defective: Mask,
    pub raise: Raise<Lanes>,
    pub swell: Option<Raise<Lanes>>,
    pub lost: Mask,
}

/// Eight touching contacts, not necessarily of one row.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct EightContacts {
    pub constants: Constants<Lanes>,
    /// Raise of the race by its waves.
    pub raise: Raise<Lanes>,
    /// Whether any race here has waves.
    pub wavy: bool,
    /// Raise of the balls by their texture, if they have one.
    pub swell: Option<Raise<Lanes>>,
    /// Position x, y, z of the ball \[m\].
    pub q: [Lanes; 3],
    /// Velocity \[m/s\] and angular speed \[rad/s\] of the ball.
    pub v: [Lanes; 4],
    /// Films of the balls, if they have any.
    pub film: Option<FilmNumbers<Lanes>>,
}

impl EightContacts {
    /// The balls' places as their rings see them.
    #[inline(always)]
    pub fn q_from(&self, ring: &RingLanes) -> [Lanes; 3] {
        let [x, y, z] = ring.centre;
        [self.q[0] + -x, self.q[1] + -y, self.q[2] + -z]
    }

    /// Velocities of the balls as seen by who moves with their rings' centres.
    #[inline(always)]
    pub fn v_from(&self, ring: &RingLanes) -> [Lanes; 3] {
        let [x, y, z] = ring.velocity;
        [self.v[0] + -x, self.v[1] + -y, self.v[2] + -z]
    }
}

/// How the rings of eight contacts stand and move, and on which side of the balls they are.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RingLanes {
    pub centre: [Lanes; 3],
    pub velocity: [Lanes; 3],
    pub omega: Lanes,
    /// σ of the races.
    pub sigma: Lanes,
}

impl RingLanes {
    /// The same ring in all lanes.
    #[inline(always)]
    pub fn of(ring: &Motion, sigma: f64) -> Self {
        Self {
            centre: [ring.centre.x, ring.centre.y, ring.z].map(Lanes::all),
            velocity: [ring.velocity.x, ring.velocity.y, ring.vz].map(Lanes::all),
            omega: Lanes::all(ring.omega),
            sigma: Lanes::all(sigma),
        }
    }

    /// Merge of two rings: this one in some lanes, another in the others.
    #[inline(always)]
    pub fn or(&self, here: Mask, other: &Self) -> Self {
        let mut both = *self;
        for i in 0..3 {
            both.centre[i] = here.choose(self.centre[i], other.centre[i]);
            both.velocity[i] = here.choose(self.velocity[i], other.velocity[i]);
        }
        both.omega = here.choose(self.omega, other.omega);
        both.sigma = here.choose(self.sigma, other.sigma);
        both
    }
}

/// Numbers of eight contacts along x and y, across the ring's axis; or along n_e and t_e.
pub(crate) type Across = [Lanes; 2];

/// Constants of a contact, or of eight.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Constants<T> {
    /// Ball radius \[m\], and one over it.
    pub radius: T,
    pub inverse: T,
    /// The race, as in `Torus`.
    pub a: T,
    pub centre: T,
    pub r: T,
    pub lowest: T,
    pub highest: T,
    /// [`crate::contact::Elastic::strength`] and [`crate::contact::Cut::half_curvature`].
    pub strength: T,
    pub half_curvature: T,
}

impl Constants<Lanes> {
    /// Merge of two places: these in some lanes, others in the others.
    #[inline(always)]
    pub fn or(&self, here: Mask, other: &Self) -> Self {
        Self {
            radius: here.choose(self.radius, other.radius),
            inverse: here.choose(self.inverse, other.inverse),
            a: here.choose(self.a, other.a),
            centre: here.choose(self.centre, other.centre),
            r: here.choose(self.r, other.r),
            lowest: here.choose(self.lowest, other.lowest),
            highest: here.choose(self.highest, other.highest),
            strength: here.choose(self.strength, other.strength),
            half_curvature: here.choose(self.half_curvature, other.half_curvature),
        }
    }

    /// Takes the constants of one contact into a lane.
    #[inline(always)]
    pub fn set(&mut self, lane: usize, of: &Constants<f64>) {
        self.radius[lane] = of.radius;
        self.inverse[lane] = of.inverse;
        self.a[lane] = of.a;
        self.centre[lane] = of.centre;
        self.r[lane] = of.r;
        self.lowest[lane] = of.lowest;
        self.highest[lane] = of.highest;
        self.strength[lane] = of.strength;
        self.half_curvature[lane] = of.half_curvature;
    }
}

impl Pair {
    /// Constants of the contact with a ball of some radius.
    pub(crate) fn constants(&self, radius: f64) -> Constants<f64> {
        let race = &self.race;
        Constants {
            radius,
            inverse: 1.0 / radius,
            a: race.a,
            centre: race.centre,
            r: race.r,
            lowest: race.lowest,
            highest: race.highest,
            strength: self.law.elastic.strength(),
            half_curvature: self.law.cut().half_curvature(),
        }
    }

    /// The balls among eight that touch, as [`Pair::evaluate`] decides it.
    #[inline(always)]
    pub(crate) fn near<const FMA: bool>(&self, balls: &Places<'_>, ring: &Motion) -> Near {
        let race = &self.race;
        let [x, y, z] = ring.place_from([balls.q[0], balls.q[1], balls.q[2]]);
        let d = x.mul_add::<FMA>(x, y * y).sqrt();
        let raise = if self.waves.is_round() {
            Raise::default()
        } else {
            self.waves.under::<FMA>([x, y], ring.theta)
        };
        // Not in a closure: that would not be compiled for the instructions of this code.
        let mut swell = None;
        if let Some((tables, turned)) = balls.texture {
            let angle = direction::<FMA>(x, y) - turned + self.outwards(0.0);
            swell = Some(HeightTable::each::<FMA>(tables, angle));
        }
        let (touching, lost) = if self.shape.is_torus() {
            let e = (d - raise.height - race.a) * race.sigma;
            let c = Lanes::all(race.centre) - z;
            let mut section = Section::new::<FMA, false>(balls.radius, Lanes::all(race.r), e, c);
            if let Some(swell) = &swell {
                section = section.raised::<FMA, false>(self.law.cut().is_flat(), swell.height);
            }
            // Negated, so that what is not a number counts as lost.
            let inside = balls
                .radius
                .map(|radius| race.farthest(radius))
                .above(section.l);
            (section.is_clear().not(), inside.not())
        } else {
            let [touching, lost] = self.near_shape(balls.radius, d - raise.height, z);
            (touching, lost)
        };
        let mut defective = Mask::default();
        if !self.defects.is_empty() && touching.any() {
            for defect in &self.defects {
                let AngularReach {
                    middle: [cos, sin],
                    bound,
                } = defect.angular_reach(ring.theta);
                defective = defective.or((x * cos + y * sin).above(d * bound));
            }
        }
        if !self.goes_by_eights() {
            defective = touching;
        }
        Near {
            touching,
            defective: defective.and(touching),
            raise,
            swell,
            lost,
        }
    }
}
