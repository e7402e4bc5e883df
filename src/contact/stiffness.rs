//! Elastic force of a contact at rest and its stiffness: what a static solve needs.
//!
//! Where all surfaces are whole, ball and groove are two circles in the meridional plane, and the force depends on the
//! places e and c of their centres alone: the kernel with derivatives by both gives force and stiffness of the same sum
//! that a run evaluates, so Newton's method converges quadratically. Near a defect, where the ball's equator
//! cuts the zone, and on races that are no tori, the stiffness is found by differences.

use nalgebra::{Matrix3, Vector3};

use super::dual::Dual;
use super::kernel::{self, Element, Receiver, Whole};
use super::profile::{Inclination, SHALLOW, Section, Zone};
use super::{
    BallSide, ContactDirection, ContactForce, Elastic, Motion, Pair, PointForce, Rules, Sink, V2,
    ZoneSlices,
};
use crate::simd::Number;
use crate::tilt::Frame;

/// Elastic force on the ball along x, y, z \[N\], and the stiffness −∂force/∂place of the ball against the ring
/// \[N/m\]; a stiffness that only differences can give is left out.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tangent {
    pub force: Vector3<f64>,
    pub stiffness: Option<Matrix3<f64>>,
}

impl Tangent {
    /// The same in the scene's frame, of a ring that tilts.
    pub(crate) fn turned(&self, frame: &Frame) -> Self {
        Self {
            force: frame.to_scene(&self.force),
            stiffness: self.stiffness.as_ref().map(|of| frame.matrix_to_scene(of)),
        }
    }
}

impl Pair {
    /// Force and stiffness at rest of a ball whose centre stands at `place` from the ring's, neither turned.
    pub(crate) fn tangent(&self, ball: &BallSide, place: &Vector3<f64>) -> Tangent {
        if !self.shape.is_torus() {
            return Tangent {
                force: self.elastic(ball, place),
                stiffness: None,
            };
        }
        let distance = place.xy().norm();
        let n = V2::new(place.x, place.y) / distance;
        let angle = if self.waves.is_round() && self.defects.is_empty() && ball.is_whole() {
            0.0
        } else {
            n.y.atan2(n.x)
        };
        let raise = self.waves.raise(angle);
        let swell = ball.waves.raise(self.outwards(angle));
        let mut section = self
            .race
            .section(ball.radius, distance, place.z, raise.height);
        if !ball.waves.is_round() {
            let is_flat = self.law.cut().is_flat();
            section = section.raised::<false, false>(is_flat, swell.height);
        }
        if section.is_clear() {
            return Tangent {
                force: Vector3::zeros(),
                stiffness: Some(Matrix3::zeros()),
            };
        }
        let sigma = self.race.sigma;
        let resting = Motion::default();
        let direction = ContactDirection::ball(&resting, n * sigma, self.outwards(angle));
        let whole = !self.is_near(angle)
            && !ball
                .defects
                .iter()
                .any(|defect| defect.in_reach(&direction));
        match self.meridional(&section, swell.height).filter(|_| whole) {
            Some(found) => {
                let (slope, bend) = (raise.slope, self.waves.bend(angle));
                let mut tangent = self.in_space(&found, n, distance, slope, bend);
                if !ball.waves.is_round() {
                    // How this turns with the place is a ten-thousandth of the contact's stiffness.
                    let share = if self.law.cut().is_flat() {
                        section.normal.cos
                    } else {
                        1.0
                    };
                    let across = -found.force[0] / share * swell.slope / distance;
                    tangent.force += Vector3::new(-n.y, n.x, 0.0) * across;
                }
                tangent
            }
            None => Tangent {
                force: self.elastic(ball, place),
                stiffness: None,
            },
        }
    }

    /// The stiffness by central differences.
    pub(crate) fn stiffness_by_differences(
        &self,
        ball: &BallSide,
        place: &Vector3<f64>,
        step: f64,
    ) -> Matrix3<f64> {
        let mut stiffness = Matrix3::zeros();
        for i in 0..3 {
            let shift = Vector3::ith(i, step);
            let fall = self.elastic(ball, &(place - shift)) - self.elastic(ball, &(place + shift));
            stiffness.set_column(i, &(fall / (2.0 * step)));
        }
        stiffness
    }

    /// Elastic force on the ball slice by slice.
    fn elastic(&self, ball: &BallSide, place: &Vector3<f64>) -> Vector3<f64> {
        let at = |centre: V2, z: f64| Motion {
            centre,
            z,
            ..Motion::default()
        };
        let mut sum = ElasticForce(Vector3::zeros());
        let ring = at(V2::zeros(), 0.0);
        self.evaluate(ball, &at(place.xy(), place.z), &ring, &mut sum);
        sum.0
    }

    /// Derivatives from the meridional plane to x, y, z: e = σ (d − a − R̃(φ)), c = z₀ − z, the waves R̃ with their first and second
    /// derivative by the angle.
    fn in_space(
        &self,
        found: &Meridional,
        n: V2,
        distance: f64,
        wave_slope: f64,
        wave_bend: f64,
    ) -> Tangent {
        let sigma = self.race.sigma;
        let [[r_e, r_c], [a_e, a_c]] = found.slope;
        let [radial, axial] = found.force;
        // Along n, t = ẑ × n and z the ball gets −σ F_r, σ F_r R̃'/d and −F_a; n and t turn with its direction, and
        // ∂e = σ ∂n − σ R̃'/d ∂t.
        let (incline, bend) = (wave_slope / distance, wave_bend / distance);
        let across = sigma * radial * incline;
        let [nn, nt, nz] = [r_e, -r_e * incline + across / distance, -sigma * r_c];
        let tt = r_e * incline * incline + sigma * radial * (1.0 - bend) / distance;
        let tz = sigma * r_c * incline;
        let [zn, zt, zz] = [sigma * a_e, -sigma * a_e * incline, -a_c];
        // The same along x, y and z.
        let (x, y) = (n.x, n.y);
        let skew = nn * x * y + nt * (x * x - y * y) - tt * x * y;
        let stiffness = Matrix3::new(
            nn * x * x - 2.0 * nt * x * y + tt * y * y,
            skew,
            nz * x - tz * y,
            skew,
            nn * y * y + 2.0 * nt * x * y + tt * x * x,
            nz * y + tz * x,
            zn * x - zt * y,
            zn * y + zt * x,
            zz,
        );
        let push = -sigma * radial;
        Tangent {
            force: Vector3::new(push * x - across * y, push * y + across * x, -axial),
            stiffness: Some(stiffness),
        }
    }

    /// Force of a whole contact, of a ball that its texture raises; none where something cuts its zone.
    fn meridional(&self, section: &Section<f64>, swell: f64) -> Option<Meridional> {
        let cut = self.law.cut();
        let zone = kernel::zone(&cut, section, cut.half_curvature());
        if !self.is_whole(section, &zone) {
            return None;
        }
        match &self.slices {
            ZoneSlices::Fitted(rules) if !cut.is_flat() => {
                Some(self.fitted_on_surface(rules, section, &zone))
            }
            ZoneSlices::Fitted(_) | ZoneSlices::Fixed(_) => {
                Some(self.differentiated(section, swell))
            }
        }
    }

    /// Whether nothing cuts a zone; fixed slices are there or not, one by one.
    fn is_whole(&self, section: &Section<f64>, zone: &Zone<f64>) -> bool {
        let (low, high) = zone.ends(section.normal);
        let fits = |zeta: f64| zeta.abs() < section.radius && self.holds(zeta - section.c);
        section.e > 0.0
            && zone.height >= SHALLOW * section.radius
            && zone.lowest(section.normal) > 0.0
            && (matches!(self.slices, ZoneSlices::Fixed(_)) || fits(low) && fits(high))
    }

    /// The kernel with derivatives by e and c, of a ball that its texture raises.
    fn differentiated(&self, section: &Section<f64>, swell: f64) -> Meridional {
        let of = Dual::constant;
        let constants = self.constants(section.radius);
        let (e, c) = (Dual::variable(section.e, 0), Dual::variable(section.c, 1));
        let mut section = Section::new::<false, false>(of(section.radius), of(section.r), e, c);
        if self.law.cut().is_flat() {
            section.approach += of(swell);
        }
        let half_curvature = of(constants.half_curvature);
        let zone = kernel::zone(&self.law.cut(), &section, half_curvature);
        let contact = Whole {
            inverse: of(constants.inverse),
            half: zone.half,
            ends: zone.ends(section.normal),
            strength: of(constants.strength),
            half_curvature,
            section,
        };
        let mut sums = ElasticSums {
            pair: self,
            section: &section,
            force: [of(0.0); 2],
        };
        let (law, slices) = (&self.law, &self.slices);
        match self.stiffness_as_one() {
            Some(stiffness) => sums.add(&as_one(&contact, stiffness)),
            None => {
                kernel::elements::<_, false, false>(law, slices, None, &contact, &mut sums);
            }
        }
        Meridional {
            force: sums.force.map(|force| force.value),
            slope: sums.force.map(|force| force.slopes),
        }
    }

    /// K of Hertz's law \[N/m^{3/2}\] where the zone's nodes follow it: their sum is K δ^{3/2} along the common normal.
    fn stiffness_as_one(&self) -> Option<f64> {
        match (&self.slices, &self.law.elastic) {
            (ZoneSlices::Fitted(_), Elastic::Hertz(law)) => {
                Some(4.0 / 3.0 * law.slope * (2.0 / law.curvature).sqrt())
            }
            _ => None,
        }
    }

    /// Stiffness as of [`Pair::differentiated`] at nodes on the common chord, u = x · half, over which the ball's surface stands
    /// at h = √(R² − u²), by hand: by the distance l and the angle α' of the normal, of which only the former changes the
    /// zone. An equilibrium takes a sixth less time for it.
    fn fitted_on_surface(
        &self,
        rules: &Rules,
        section: &Section<f64>,
        zone: &Zone<f64>,
    ) -> Meridional {
        let (l, r, radius) = (section.l, section.r, section.radius);
        let (Inclination { cos, sin }, half) = (section.normal, zone.half);
        // ∂half/∂l over half; the chord's height is R − sum with sum = (l + 2R + (R² − r²)/l)/2.
        let sum_rate = 0.5 * (1.0 - (radius * radius - r * r) / (l * l));
        let half_rate = zone.height * sum_rate / (half * half);
        let exponent = self.law.elastic.exponent();
        let mut force = [0.0; 2];
        let (mut by_distance, mut by_angle) = ([0.0; 2], [0.0; 2]);
        for &(x, weight) in rules.on([true, true]) {
            let u = x * half;
            let u_rate = u * half_rate;
            let h = (radius * radius - u * u).sqrt();
            let per_h = 1.0 / h;
            let h_rate = -u * u_rate * per_h;
            let (rho, zeta) = (h * cos - u * sin, h * sin + u * cos);
            let (rho_rate, zeta_rate) = (h_rate * cos - u_rate * sin, h_rate * sin + u_rate * cos);
            // The slice from the groove's centre, and the groove's height there.
            let (out, along) = (rho + l * cos, zeta + l * sin);
            let groove = (r * r - along * along).sqrt();
            let depth = out - groove;
            if depth <= 0.0 {
                continue;
            }
            let tilt = along / groove;
            let per_rho = 1.0 / rho;
            let depth_rate = rho_rate + cos + tilt * (zeta_rate + sin);
            let depth_turn = tilt * out - along;
            let pressed = self.law.elastic.force(depth, half * weight * rho * per_h);
            let tan = zeta * per_rho;
            let stiff = exponent / depth;
            let rate =
                pressed * (half_rate + rho_rate * per_rho - h_rate * per_h + stiff * depth_rate);
            let turn = pressed * (stiff * depth_turn - tan);
            add(&mut force, pressed, pressed * tan);
            let tan_rate = (zeta_rate - tan * rho_rate) * per_rho;
            add(&mut by_distance, rate, rate * tan + pressed * tan_rate);
            let tan_turn = 1.0 + tan * tan;
            add(&mut by_angle, turn, turn * tan + pressed * tan_turn);
        }
        Meridional {
            force,
            slope: by_axes(section, by_distance, by_angle),
        }
    }

    /// Whether the race is there, at a place from the groove's centre.
    fn holds(&self, x: f64) -> bool {
        x.abs() < self.race.r && x >= self.race.lowest && x <= self.race.highest
    }
}

/// Adds up the elastic forces along n_e and z of elements that lie on the race.
struct ElasticSums<'a> {
    pair: &'a Pair,
    section: &'a Section<Dual<f64, 2>>,
    force: [Dual<f64, 2>; 2],
}

impl ElasticSums<'_> {
    fn add(&mut self, element: &Element<Dual<f64, 2>>) {
        let elastic = element.load * element.length;
        self.force[0] += elastic * element.share.0;
        self.force[1] += elastic * element.share.1;
    }
}

impl Receiver<Dual<f64, 2>> for ElasticSums<'_> {
    #[inline(always)]
    fn element<const FMA: bool, const SYMMETRIC: bool>(
        &mut self,
        element: &Element<Dual<f64, 2>>,
        _times: u32,
    ) {
        let place = element.sin.value * self.section.radius.value - self.section.c.value;
        if self.pair.holds(place) {
            self.add(element);
        }
    }
}

/// Force of a whole contact in its meridional plane.
struct Meridional {
    /// F_r along n_e and F_a along z \[N\].
    force: [f64; 2],
    /// Derivatives of each by e and c \[N/m\].
    slope: [[f64; 2]; 2],
}

/// Derivatives by e and c from those by the distance l and the normal's angle α': e = l cos α', c = −l sin α'.
fn by_axes(section: &Section<f64>, by_distance: [f64; 2], by_angle: [f64; 2]) -> [[f64; 2]; 2] {
    let Inclination { cos, sin } = section.normal;
    [0, 1].map(|i| {
        let turn = by_angle[i] / section.l;
        [
            by_distance[i] * cos - turn * sin,
            -by_distance[i] * sin - turn * cos,
        ]
    })
}

fn add(sum: &mut [f64; 2], first: f64, second: f64) {
    sum[0] += first;
    sum[1] += second;
}

/// Adds up the elastic forces on the ball.
struct ElasticForce(Vector3<f64>);

impl Sink for ElasticForce {
    fn force(&mut self, force: &ContactForce) {
        let plane = force.n_e * (force.elastic * force.share.0);
        self.0 -= Vector3::new(plane.x, plane.y, force.elastic * force.share.1);
    }

    fn point(&mut self, force: &PointForce) {
        self.0 += Vector3::new(force.plane.x, force.plane.y, force.axial);
    }
}

/// Hertz's force as a whole, K δ^{3/2}, where every element approaches alike and nothing rubs: along the common normal,
/// in place of all elements.
#[inline(always)]
fn as_one<T: Number>(contact: &Whole<T>, stiffness: f64) -> Element<T> {
    let pressed = contact.section.approach.or_zero();
    let (zero, one) = (pressed.same(0.0), pressed.same(1.0));
    Element {
        sin: zero,
        slope: Inclination {
            cos: one,
            sin: zero,
        },
        groove: zero,
        depth: pressed,
        length: one,
        load: pressed * pressed.sqrt() * stiffness,
        share: contact.section.normal.share(),
        friction_weight: one,
    }
}

#[cfg(test)]
mod tests;
