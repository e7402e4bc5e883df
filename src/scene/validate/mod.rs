//! All checks of a scene; each error names the field.

mod bearing;
mod check;
mod contact;
mod defect;
mod load;
mod lubricant;
mod probe;
mod race;
mod texture;
mod tilt;

use super::{RingName, Row, SCHEMA, Scene};
use crate::base::error::{Error, Result};
use check::{entry_name, positive, within};

impl Scene {
    /// Checks every field; [`crate::compile()`] does it for you.
    ///
    /// # Errors
    /// [`Error::Scene`] with the path, the value and what is allowed, for the first field that is not usable.
    pub fn validate(&self) -> Result<()> {
        if self.schema != SCHEMA {
            return Err(Error::scene(
                "schema",
                self.schema,
                format!("must be {SCHEMA}"),
            ));
        }
        if self.rows.is_empty() || self.rows.len() > 16 {
            return Err(Error::scene("rows", self.rows.len(), "1 to 16 rows"));
        }
        for (i, row) in self.rows.iter().enumerate() {
            bearing::row(&format!("rows[{i}]"), row)?;
            race::races(&format!("rows[{i}]"), row, self.contact_of(row))?;
            contact::of_row(&format!("rows[{i}]"), row)?;
            texture::texture(self, i)?;
        }
        bearing::ring(self, RingName::Outer)?;
        bearing::ring(self, RingName::Inner)?;
        tilt::ring(self, RingName::Outer)?;
        tilt::ring(self, RingName::Inner)?;
        contact::materials(&self.materials)?;
        contact::contact("contact", &self.contact)?;
        contact::friction("friction", &self.friction)?;
        if let Some(cage) = &self.cage {
            within("cage.stiffness", cage.stiffness, 0.0..=1e15, "N/m")?;
            within("cage.damping", cage.damping, 0.0..=1e12, "N s/m")?;
            within("cage.play", cage.play, 0.0..=1.0, "m")?;
        }
        load::drive(self)?;
        lubricant::lubricants(self)?;
        for (i, g) in self.gravity.iter().enumerate() {
            within(&format!("gravity[{i}]"), *g, -1e6..=1e6, "m/s²")?;
        }
        load::loads(self)?;
        tilt::loads(self)?;
        self.check_tilted()?;
        for (name, defect) in &self.defects {
            entry_name("defects", name)?;
            defect::defect(self, &format!("defects.{name}"), defect)?;
        }
        for (name, probe) in &self.probes {
            entry_name("probes", name)?;
            probe::probe(self, &format!("probes.{name}"), probe)?;
        }
        self.approximations.validate(self)?;
        within("solver.rtol", self.solver.rtol, 1e-12..=1e-1, "")?;
        for (path, step) in [
            ("solver.first_step", self.solver.first_step),
            ("solver.max_step", self.solver.max_step),
        ] {
            if let Some(step) = step {
                positive(path, step, "s")?;
            }
        }
        Ok(())
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
