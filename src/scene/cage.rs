//! The cage: links between neighbouring balls, or a rigid ring with a pocket for each of them.

use std::f64::consts::PI;

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};

use super::Row;
use super::document::at_field;
use super::numbers::{BoundedNumber, up_to};

/// Density of the steel of a cage whose mass is not given \[kg/m³\].
const STEEL: f64 = 7800.0;
/// Section of the ring over the ball diameter, along the radius and along the axis.
const SECTION: [f64; 2] = [0.2, 0.9];
/// Share of a ball's circle that a pocket takes out of the ring: its bars and rims go round the ball.
const CUT_OUT: f64 = 0.5;

/// Sag of a centred cage by its weight over the usual clearance of its pockets, and gravity there \[m/s²\].
const SAG: f64 = 1.0 / 6.0;
const STANDARD_GRAVITY: f64 = 9.81;

/// Cage: keeps the balls of a row apart.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
#[non_exhaustive]
pub enum Cage {
    /// Springs between neighbours, the paper's.
    Links(CageLinks),
    /// A rigid body with pockets: `cage = { ring = { … } }`.
    Ring {
        /// The ring.
        ring: Box<CageRing>,
    },
}

impl Cage {
    /// Links of a stiffness \[N/m\], with damping \[N s/m\] and total play \[m\].
    pub fn new(stiffness: f64, damping: f64, play: f64) -> Self {
        Self::Links(CageLinks {
            stiffness,
            damping,
            play,
        })
    }

    /// A rigid ring with pockets.
    pub fn ring(ring: CageRing) -> Self {
        Self::Ring {
            ring: Box::new(ring),
        }
    }

    /// Links of the cage, if it has some.
    pub fn links(&self) -> Option<&CageLinks> {
        match self {
            Self::Links(links) => Some(links),
            Self::Ring { .. } => None,
        }
    }

    /// The rigid ring, if it is one.
    pub fn as_ring(&self) -> Option<&CageRing> {
        match self {
            Self::Links(_) => None,
            Self::Ring { ring } => Some(ring),
        }
    }
}

/// A cage as a document has it: the fields of links, or a ring.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CageDocument {
    stiffness: Option<f64>,
    damping: Option<f64>,
    play: Option<f64>,
    ring: Option<Box<CageRing>>,
}

impl<'de> Deserialize<'de> for Cage {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let CageDocument {
            stiffness,
            damping,
            play,
            ring,
        } = CageDocument::deserialize(deserializer)?;
        let of_links = [
            ("stiffness", stiffness),
            ("damping", damping),
            ("play", play),
        ];
        match (ring, stiffness) {
            (None, Some(stiffness)) => Ok(Self::new(
                stiffness,
                damping.unwrap_or_default(),
                play.unwrap_or_default(),
            )),
            (None, None) => Err(D::Error::missing_field("stiffness")),
            (Some(ring), _) => match of_links.iter().find(|(_, value)| value.is_some()) {
                None => Ok(Self::Ring { ring }),
                Some((field, _)) => Err(at_field(
                    field,
                    "left out beside a ring, which has numbers of its own",
                )),
            },
        }
    }
}

/// Springs that keep the centres of neighbouring balls of a row at their distance ([*Cage*](crate::equations#cage-supports-loads-drive)).
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct CageLinks {
    /// Stiffness k_c \[N/m\].
    pub stiffness: f64,
    /// Damping c_c, while engaged \[N s/m\].
    pub damping: f64,
    /// Total play p \[m\]: free within ± p/2 of the nominal distance.
    pub play: f64,
}

impl CageLinks {
    /// Numbers of the links.
    pub(super) fn numbers(&self) -> [BoundedNumber; 3] {
        // Named one by one, so that the compiler asks about a new field.
        let Self {
            stiffness,
            damping,
            play,
        } = *self;
        [
            BoundedNumber::new("stiffness", stiffness, 0.0..=1e15, "N/m"),
            BoundedNumber::new("damping", damping, 0.0..=1e12, "N s/m"),
            BoundedNumber::new("play", play, 0.0..=1.0, "m"),
        ]
    }
}

/// Guidance of a cage that is a ring: what carries it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum CageGuidance {
    /// A soft spring and a damper hold the cage's free centre at that of the outer ring.
    #[default]
    Centred,
    /// The outer ring's centre is the cage's, which has a moment of inertia and no mass. What balls do to the pockets strikes the ring.
    Held,
    /// A land of the outer ring carries the cage, whose centre is free, with weight.
    Outer,
    /// The same on a land of the inner ring.
    Inner,
    /// The balls carry the cage in round pockets; its centre is free, with weight.
    Balls,
}

/// A rigid ring around the axis with a pocket for each ball of a row; every row has one of its own.
///
/// ```
/// use ballrace::scene::{Cage, CageRing, presets};
/// let mut scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
/// scene.cage = Some(Cage::ring(CageRing::default()));
/// let found = ballrace::start(&ballrace::compile(&scene).unwrap(), &ballrace::Start::Equilibrium);
/// assert!(found.is_ok());
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
#[non_exhaustive]
pub struct CageRing {
    /// Mass \[kg\]; absent: of a steel ring of 0.2 D × 0.9 D around the pitch circle less its pockets, 8 g for a 6205.
    pub mass: Option<f64>,
    /// Moment of inertia about its axis \[kg m²\]; absent: the mass times the square of the pitch radius.
    pub inertia: Option<f64>,
    /// Distance of its centre of mass from its centre, towards its pocket 0 \[m\]; only of a cage whose centre is free.
    pub eccentricity: f64,
    /// Clearance c_p of a ball on either side of its pocket \[m\], half of the play; absent: D/160, 50 µm at D = 8 mm.
    pub pocket_clearance: Option<f64>,
    /// Stiffness k_p of a pocket's wall \[N/m\]; absent: 3.75·10⁷ N/m² D, 3·10⁵ N/m at D = 8 mm.
    pub stiffness: Option<f64>,
    /// Damping d_p of a pocket's wall \[N s/m\]; absent: √(k_p m_b), half of the critical one.
    pub damping: Option<f64>,
    /// Depth δ₀ over which that damping sets in \[m\].
    pub damping_depth: f64,
    /// Coefficient of friction μ_p of ball and pocket.
    pub friction: f64,
    /// Slip speed below which friction in pockets and on the land fades \[m/s\]; absent: that of the row's friction, or 0.01 m/s.
    pub slip_speed: Option<f64>,
    /// Errors ε of the pockets' angles \[rad\], one for each ball of a row; empty: none.
    pub pocket_errors: Vec<f64>,
    /// Standard deviation of further errors, drawn from the seed \[rad\].
    pub pocket_error: f64,
    /// Seed of the errors that are drawn.
    pub seed: u64,
    /// Guidance: what carries the cage.
    pub guided: CageGuidance,
    /// Stiffness of the spring that centres it \[N/m\], with half of the critical damping; absent: one on which its weight lowers it
    /// by a sixth of the usual clearance of its pockets, 9.4·10³ N/m in a 6205.
    pub centring_stiffness: Option<f64>,
    /// Clearance c_g of the cage in its land, along any radius \[m\]; absent: c_p. With more the pockets carry the cage.
    pub land_clearance: Option<f64>,
    /// Radius of the land \[m\]; absent: that of the ring's shoulders, or 0.3 D beyond the pitch radius.
    pub land_radius: Option<f64>,
    /// Stiffness of the land \[N/m\]; its damping is half of the critical one.
    pub land_stiffness: f64,
    /// Coefficient of friction on the land.
    pub land_friction: f64,
}

impl Default for CageRing {
    fn default() -> Self {
        Self {
            mass: None,
            inertia: None,
            eccentricity: 0.0,
            pocket_clearance: None,
            stiffness: None,
            damping: None,
            damping_depth: 0.2e-6,
            friction: 0.02,
            slip_speed: None,
            pocket_errors: Vec::new(),
            pocket_error: 0.0,
            seed: 0,
            guided: CageGuidance::default(),
            centring_stiffness: None,
            land_clearance: None,
            land_radius: None,
            land_stiffness: 1e6,
            land_friction: 0.05,
        }
    }
}

impl CageRing {
    /// Clearance c_p in a pocket of a ball of a diameter \[m\].
    pub fn pocket_clearance(&self, ball_diameter: f64) -> f64 {
        self.pocket_clearance.unwrap_or(ball_diameter / 160.0)
    }

    /// Stiffness k_p of a pocket's wall of a ball of a diameter \[m\], in N/m.
    pub fn stiffness(&self, ball_diameter: f64) -> f64 {
        self.stiffness.unwrap_or(3.75e7 * ball_diameter)
    }

    /// Stiffness k_h of the spring that centres the cage of a row \[N/m\].
    pub fn centring_stiffness(&self, row: &Row) -> f64 {
        let sag = SAG * Self::default().pocket_clearance(row.ball_diameter);
        self.centring_stiffness
            .unwrap_or(self.mass(row) * STANDARD_GRAVITY / sag)
    }

    /// Mass of the cage of a row \[kg\].
    pub fn mass(&self, row: &Row) -> f64 {
        let d = row.ball_diameter;
        let [thick, wide] = SECTION.map(|share| share * d);
        let whole = PI * row.pitch_diameter * thick * wide;
        let pocket = CUT_OUT * PI / 4.0 * d * d * thick;
        self.mass
            .unwrap_or(STEEL * (whole - row.ball_count as f64 * pocket))
    }

    /// Moment of inertia of the cage of a row about its axis \[kg m²\].
    pub fn inertia(&self, row: &Row) -> f64 {
        let radius = row.pitch_diameter / 2.0;
        self.inertia.unwrap_or(self.mass(row) * radius * radius)
    }

    /// Numbers of the ring.
    pub(super) fn numbers(&self) -> [BoundedNumber; 15] {
        // Named one by one, so that the compiler asks about a new field.
        let Self {
            mass,
            inertia,
            eccentricity,
            pocket_clearance,
            stiffness,
            damping,
            damping_depth,
            friction,
            slip_speed,
            pocket_errors: _,
            pocket_error,
            seed: _,
            guided: _,
            centring_stiffness,
            land_clearance,
            land_radius,
            land_stiffness,
            land_friction,
        } = self;
        [
            BoundedNumber::new("mass", *mass, up_to(1e6), "kg"),
            BoundedNumber::new("inertia", *inertia, up_to(1e6), "kg m²"),
            BoundedNumber::new("eccentricity", *eccentricity, 0.0..=1.0, "m"),
            BoundedNumber::new("pocket_clearance", *pocket_clearance, 0.0..=1.0, "m"),
            BoundedNumber::new("stiffness", *stiffness, 0.0..=1e15, "N/m"),
            BoundedNumber::new("damping", *damping, 0.0..=1e12, "N s/m"),
            BoundedNumber::new("damping_depth", *damping_depth, up_to(1.0), "m"),
            BoundedNumber::new("friction", *friction, 0.0..=10.0, ""),
            BoundedNumber::new("slip_speed", *slip_speed, up_to(1e3), "m/s"),
            BoundedNumber::new("pocket_error", *pocket_error, 0.0..=0.1, "rad"),
            BoundedNumber::new(
                "centring_stiffness",
                *centring_stiffness,
                up_to(1e15),
                "N/m",
            ),
            BoundedNumber::new("land_clearance", *land_clearance, 0.0..=1.0, "m"),
            BoundedNumber::new("land_radius", *land_radius, up_to(100.0), "m"),
            BoundedNumber::new("land_stiffness", *land_stiffness, 0.0..=1e15, "N/m"),
            BoundedNumber::new("land_friction", *land_friction, 0.0..=10.0, ""),
        ]
    }
}
