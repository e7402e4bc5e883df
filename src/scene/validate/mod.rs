//! Validation of a scene; each error names the field.

mod bearing;
mod cage;
mod check;
mod contact;
mod defect;
mod load;
mod lubricant;
mod probe;
mod race;
mod structure;
mod texture;
mod tilt;

use super::{RingName, Row, SCHEMA, Scene};
use crate::base::error::{Error, Result};
use check::{entry_name, finite, numbers};

impl Scene {
    /// Checks every field; [`crate::compile()`] does it for you.
    ///
    /// # Errors
    /// [`Error::Scene`] with the path, the value and what is allowed, for the first field that is not usable.
    pub fn validate(&self) -> Result<()> {
        // Named one by one, so that the compiler asks what is allowed of a new field.
        let Self {
            schema,
            name: _,
            rows,
            outer_ring: _,
            inner_ring: _,
            structure,
            materials,
            contact,
            friction,
            lubricant: _,
            spin: _,
            cage,
            drive: _,
            outer_speed: _,
            gravity: _,
            loads: _,
            moments: _,
            unbalances: _,
            table_forces: _,
            ring_forces,
            defects,
            probes,
            solver,
        } = self;
        if *schema != SCHEMA {
            return Err(Error::scene("schema", schema, format!("must be {SCHEMA}")));
        }
        if rows.is_empty() || rows.len() > 16 {
            return Err(Error::scene("rows", rows.len(), "1 to 16 rows"));
        }
        for (i, row) in rows.iter().enumerate() {
            bearing::row(&format!("rows[{i}]"), row)?;
            race::races(&format!("rows[{i}]"), row, self.contact_of(row))?;
            contact::of_row(&format!("rows[{i}]"), row)?;
            texture::texture(self, i)?;
        }
        bearing::ring(self, RingName::Outer)?;
        bearing::ring(self, RingName::Inner)?;
        tilt::ring(self, RingName::Outer)?;
        tilt::ring(self, RingName::Inner)?;
        contact::materials(materials)?;
        contact::contact("contact", contact)?;
        contact::friction("friction", friction)?;
        if let Some(cage) = cage {
            cage::cage(self, cage)?;
        }
        if let Some(of) = structure {
            structure::structure(self, of)?;
        }
        load::drive(self)?;
        lubricant::lubricants(self)?;
        numbers("", self.numbers())?;
        load::loads(self)?;
        tilt::loads(self)?;
        for (name, force) in ring_forces.iter() {
            let path = format!("ring_forces.{name}");
            finite(&format!("{path}.stiffness"), force.stiffness())?;
            finite(&format!("{path}.damping"), force.damping())?;
            for (i, peak) in force.peak().into_iter().enumerate() {
                finite(&format!("{path}.peak[{i}]"), peak)?;
            }
        }
        for (name, defect) in defects {
            entry_name("defects", name)?;
            defect::defect(self, &format!("defects.{name}"), defect)?;
        }
        for (name, probe) in probes {
            entry_name("probes", name)?;
            probe::probe(self, &format!("probes.{name}"), probe)?;
        }
        numbers("solver", solver.numbers())
    }

    /// Checks what fault frequencies and lines depend on, its rows and speeds.
    pub(crate) fn validate_kinematics(&self) -> Result<()> {
        if self.rows.is_empty() {
            return Err(Error::scene("rows", 0, "1 to 16 rows"));
        }
        for (i, row) in self.rows.iter().enumerate() {
            bearing::row(&format!("rows[{i}]"), row)?;
        }
        load::drive(self)
    }

    pub(super) fn row_index(&self, path: &str, row: usize) -> Result<&Row> {
        self.rows.get(row).ok_or_else(|| {
            Error::scene(
                format!("{path}.row"),
                row,
                format!("below {}, the number of rows", self.rows.len()),
            )
        })
    }

    /// Index of a body by its name: `outer` 0, `inner` 1, then the balls row by row.
    pub fn body_index(&self, name: &str) -> Option<usize> {
        match name {
            "outer" => Some(0),
            "inner" => Some(1),
            _ => {
                let (row, ball) = name.strip_prefix("row")?.split_once(".ball")?;
                let (row, ball): (usize, usize) = (row.parse().ok()?, ball.parse().ok()?);
                if ball >= self.rows.get(row)?.ball_count {
                    return None;
                }
                let before: usize = self.rows[..row].iter().map(|r| r.ball_count).sum();
                Some(2 + before + ball)
            }
        }
    }
}
