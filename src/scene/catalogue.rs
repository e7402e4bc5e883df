//! Bearings by their designations: the table of the Python package, embedded (feature `catalogue`).
//!
//! A name here is a bearing's own, `6205` or `7208B`: seals, cages, clearances and makers are no part of it, and are refused with the name
//! that is; [`all`] lists what there is.

use std::sync::LazyLock;

use serde::{Deserialize, Serialize};

use super::Row;
use super::expected::nearest;
use crate::base::error::{Error, Result};

/// One line a bearing: millimetres, degrees, newtons.
const TABLE: &str = include_str!("../../python/ballrace/bearings/bearings.csv");

/// Groove radii over the ball's diameter, which no maker prints: usual ones.
const CONFORMITIES: [f64; 2] = [0.53, 0.52];

static BEARINGS: LazyLock<Vec<Bearing>> =
    LazyLock::new(|| TABLE.lines().skip(1).filter_map(Bearing::of_line).collect());

/// Kind of a bearing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum BearingKind {
    /// Deep groove.
    DeepGroove,
    /// Angular contact.
    AngularContact,
    /// Two rows of angular contact, alike, back to back.
    DoubleRow,
    /// Thrust.
    Thrust,
}

/// A bearing of the catalogue.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Bearing {
    /// Name, without maker, seals and clearance.
    pub designation: String,
    /// Kind.
    pub kind: BearingKind,
    /// Number of balls of a row.
    pub ball_count: usize,
    /// Ball diameter \[m\].
    pub ball_diameter: f64,
    /// Pitch diameter \[m\].
    pub pitch_diameter: f64,
    /// Bore \[m\].
    pub bore: f64,
    /// Outside diameter \[m\].
    pub outside_diameter: f64,
    /// Width of the outer ring, of a thrust bearing the height \[m\].
    pub width: f64,
    /// Nominal contact angle \[rad\].
    pub contact_angle: f64,
    /// Basic dynamic load rating C of ISO 281, of a thrust bearing the axial one \[N\].
    pub dynamic_rating: f64,
    /// Basic static load rating C₀ of ISO 76, likewise \[N\].
    pub static_rating: f64,
}

impl Bearing {
    fn of_line(line: &str) -> Option<Self> {
        let fields: Vec<&str> = line.split(',').collect();
        let number = |at: usize| fields.get(at)?.parse::<f64>().ok();
        // As a decimal number of metres.
        let metres = |at: usize| format!("{}e-3", fields.get(at)?).parse::<f64>().ok();
        let kind = match *fields.get(1)? {
            "deep_groove" => BearingKind::DeepGroove,
            "angular_contact" => BearingKind::AngularContact,
            "double_row" => BearingKind::DoubleRow,
            "thrust" => BearingKind::Thrust,
            _ => return None,
        };
        Some(Self {
            designation: fields[0].to_owned(),
            kind,
            ball_count: fields.get(2)?.parse().ok()?,
            ball_diameter: metres(3)?,
            pitch_diameter: metres(4)?,
            bore: metres(5)?,
            outside_diameter: metres(6)?,
            width: metres(7)?,
            contact_angle: number(8)?.to_radians(),
            dynamic_rating: number(9)?,
            static_rating: number(10)?,
        })
    }

    /// Row of the bearing for a scene, with conformities of 0.53 and 0.52, which are assumed. Fault frequencies depend on its
    /// [`Row::geometry`].
    pub fn row(&self) -> Row {
        let [outer, inner] = CONFORMITIES;
        let mut row = Row::new(
            self.ball_count,
            self.ball_diameter,
            self.pitch_diameter,
            outer,
            inner,
        );
        row.contact_angle = self.contact_angle;
        row
    }
}

/// All bearings, in the order of the table.
pub fn all() -> &'static [Bearing] {
    &BEARINGS
}

/// The bearing of a designation, upper or lower case.
///
/// ```
/// use ballrace::scene::catalogue;
/// let bearing = catalogue::find("6205")?;
/// let rates = bearing.row().geometry().orders().at(1797.0 / 60.0);
/// assert!((rates.bpfo - 107.36).abs() < 0.01); // Hz
/// # Ok::<(), ballrace::Error>(())
/// ```
///
/// # Errors
/// [`Error::Argument`] at `designation` names the one that may be meant; of a name with suffixes, as `6205-2RS/C3`, the one without.
pub fn find(designation: &str) -> Result<&'static Bearing> {
    let wanted = designation.trim();
    let mut known = BEARINGS.iter();
    let found = known.find(|bearing| bearing.designation.eq_ignore_ascii_case(wanted));
    found.ok_or_else(|| {
        let allowed = bare(wanted).map_or_else(
            || {
                let names: Vec<&str> = BEARINGS.iter().map(|of| of.designation.as_str()).collect();
                let perhaps = nearest(wanted, &names).map(|name| format!(", perhaps {name}"));
                format!(
                    "one of the {} designations of the catalogue{}",
                    names.len(),
                    perhaps.unwrap_or_default()
                )
            },
            |bare| format!("without suffixes for seals, cage, clearance and maker: {bare}"),
        );
        Error::argument("designation", designation, allowed)
    })
}

/// The longest designation with which a longer name begins, up to a sign or letters that stand after its digits.
fn bare(name: &str) -> Option<&'static str> {
    let known = BEARINGS.iter().map(|bearing| bearing.designation.as_str());
    let begins = known.filter(|of| {
        let head = name.get(..of.len());
        let rest = name.get(of.len()..).and_then(|rest| rest.chars().next());
        head.is_some_and(|head| head.eq_ignore_ascii_case(of))
            && rest.is_some_and(|next| !next.is_ascii_digit())
    });
    begins.max_by_key(|of| of.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Reliability: every line of the table is a bearing, whose row is possible.
    #[test]
    fn every_line_is_a_bearing() {
        assert_eq!(all().len(), TABLE.lines().count() - 1);
        for bearing in all() {
            let gap =
                bearing.pitch_diameter * (std::f64::consts::PI / bearing.ball_count as f64).sin();
            assert!(gap > bearing.ball_diameter, "{}", bearing.designation);
            assert!(bearing.bore < bearing.pitch_diameter);
            assert!(bearing.pitch_diameter < bearing.outside_diameter);
            assert_eq!(find(&bearing.designation), Ok(bearing));
        }
    }

    #[test]
    fn what_is_not_there_is_refused_with_what_may_be_meant() {
        let refused = find("62055").unwrap_err().to_string();
        assert!(
            refused.starts_with("designation = 62055") && refused.contains("perhaps 6205"),
            "{refused}"
        );
    }

    /// The longest name that is the bearing's own is named: seals, cages, clearances and makers may stand behind it.
    #[test]
    fn suffixes_are_refused_by_the_name_without_them() {
        for (name, bare) in [
            ("6205-2RS/C3", "6205"),
            ("6205zz", "6205"),
            ("6205 2RSR", "6205"),
            ("7208B-TVP", "7208B"),
            ("7208b.tvp", "7208B"),
        ] {
            let refused = find(name).unwrap_err().to_string();
            let expected = format!(
                "designation = {name}: without suffixes for seals, cage, clearance and maker: {bare}"
            );
            assert_eq!(refused, expected);
        }
        for name in ["620512", "SKF 6205", ""] {
            let refused = find(name).unwrap_err().to_string();
            assert!(
                refused.contains("designations of the catalogue"),
                "{refused}"
            );
        }
    }
}
