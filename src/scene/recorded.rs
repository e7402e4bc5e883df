//! Bodies that can move, and what a run records by default.

use std::borrow::Cow;
use std::collections::BTreeMap;

use super::{
    Component, ContactQuantity, ContactsProbe, Drive, MotionProbe, Mount, Probe, Scene, Support,
};

/// The rings in the order of the bodies: name, as in columns and states.
const RINGS: [&str; 2] = ["outer", "inner"];

impl Scene {
    /// The probes of a run: those of the scene. Where it has none, the motion of the outer ring if forces can move it along x,
    /// y or z, else that of the inner ring, each in the directions that can move; where both rings are held or follow given
    /// motions, the loads of all contacts: `row0`, `row1`, … With a structure also its sensors, `housing`, and the force on its seat, `seat`.
    ///
    /// ```
    /// let mut scene = ballrace::scene::presets::deep_groove_6205(500.0, 0.0, 1800.0);
    /// scene.probes.clear();
    /// // The outer ring is sprung along x, y and z, and does not turn.
    /// assert!(scene.recorded().contains_key("outer"));
    /// scene.outer_ring.support = Default::default();
    /// assert!(scene.recorded().contains_key("inner"));
    /// ```
    pub fn recorded(&self) -> Cow<'_, BTreeMap<String, Probe>> {
        if !self.probes.is_empty() {
            return Cow::Borrowed(&self.probes);
        }
        let moving = (0..2).find(|ring| self.is_moved(*ring));
        let mut recorded: BTreeMap<String, Probe> = match moving {
            Some(ring) => [(RINGS[ring].to_owned(), self.motion(ring))].into(),
            None => (0..self.rows.len()).map(contact_loads).collect(),
        };
        if let Some(structure) = &self.structure {
            if !structure.sensors().is_empty() {
                recorded.insert("housing".to_owned(), Probe::structure());
            }
            recorded.insert("seat".to_owned(), Probe::seat());
        }
        Cow::Owned(recorded)
    }

    /// Whether a body can move along x, y, z and about z, tilt about x and y, and turn freely about x and y; numbered as by
    /// [`Scene::body_index`].
    pub(super) fn moves(&self, body: usize) -> [bool; 8] {
        let can = |support: &Support, absent| {
            let [x, y, z, theta] = support.mounts(absent).map(|mount| mount != Mount::Fixed);
            let [tilt_x, tilt_y] = support.tilt_mounts().map(|mount| mount != Mount::Fixed);
            let turns = self.balls_turn();
            [x, y, z, theta, tilt_x, tilt_y, turns, turns]
        };
        match body {
            0 => {
                let mut moves = can(&self.outer_ring.support, Mount::Fixed);
                moves[3] |= self.outer_speed.is_some();
                moves
            }
            1 => {
                let mut moves = can(&self.inner_ring.support, Mount::Free);
                moves[3] |= matches!(self.drive, Drive::Speed(_));
                moves
            }
            _ => {
                let mut ball = body - 2;
                let row = self.rows.iter().find(|row| {
                    let is_here = ball < row.ball_count;
                    ball = ball.saturating_sub(row.ball_count);
                    is_here
                });
                row.map_or([true; 8], |row| can(&row.ball_support, Mount::Free))
            }
        }
    }

    /// Whether forces move a ring along x, y or z.
    fn is_moved(&self, ring: usize) -> bool {
        let [outer, inner] = [&self.outer_ring, &self.inner_ring].map(|ring| &ring.support);
        let mounts = [outer.mounts(Mount::Fixed), inner.mounts(Mount::Free)];
        mounts[ring][..3].iter().any(Mount::gives)
    }

    /// The motion of a ring as far as it can move.
    fn motion(&self, ring: usize) -> Probe {
        let moves = self.moves(ring);
        let can_move = |component: &Component| moves[component.direction()];
        let components = self.components_of(RINGS[ring]).into_iter();
        let components: Vec<Component> = components.filter(can_move).collect();
        MotionProbe::of(RINGS[ring]).components(components).into()
    }
}

fn contact_loads(row: usize) -> (String, Probe) {
    let loads = ContactsProbe::of_row(row).quantities([ContactQuantity::Load]);
    (format!("row{row}"), loads.into())
}
