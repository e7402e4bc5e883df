//! Offsets of a state vector.

use super::*;

/// Truth: the order of `Model::names`.
#[test]
fn every_place_has_one_owner() {
    let layout = Layout::of_balls(3);
    assert_eq!((layout.half(), layout.dim()), (20, 40));
    for (at, (body, dof)) in layout.degrees().enumerate() {
        assert_eq!(layout.at(body, dof), at);
        assert_eq!(layout.speed_at(body, dof), 20 + at);
    }
    let y: Vec<f64> = (0..layout.dim()).map(|i| i as f64).collect();
    let motion = layout.motion(&y, BodyId::ball(1));
    assert_eq!(
        (motion.centre.x, motion.z, motion.omega),
        (12.0, 14.0, 35.0)
    );
    assert_eq!(layout.centre(&y, BodyId::INNER), [4.0, 5.0, 6.0]);
}

/// Truth: places of bodies stay, and every tilt that moves has one behind them.
#[test]
fn tilts_stand_behind_all_bodies() {
    let plain = Layout::of_balls(2);
    for mask in 0..16_u8 {
        let moves = |bit: u8| mask >> bit & 1 == 1;
        let layout = plain.with_tilts([[moves(0), moves(1)], [moves(2), moves(3)]]);
        assert_eq!(layout.half(), 16 + mask.count_ones() as usize);
        for (at, (body, dof)) in layout.degrees().enumerate() {
            assert!(layout.has(body, dof));
            assert_eq!(layout.at(body, dof), at);
            if at < 16 {
                assert_eq!(plain.at(body, dof), at);
            }
        }
        assert_eq!(layout.has(BodyId::INNER, Dof::TiltX), moves(2));
        assert!(!layout.has(BodyId::ball(0), Dof::TiltX));
    }
}

#[test]
fn rings_stand_before_balls() {
    assert_eq!(BodyId::ball(0).index(), 2);
    let layout = Layout::of_balls(6);
    assert_eq!(layout.as_ball(BodyId::ball(5)), Some(5));
    for race in Race::BOTH {
        assert_eq!(layout.kind(race.ring()), BodyKind::Ring(race));
        assert_eq!(
            (layout.as_ball(race.ring()), race.other().other()),
            (None, race)
        );
    }
}

/// Truth: the order of `Model::names`.
#[test]
fn cages_stand_behind_the_balls() {
    let layout = Layout::of_balls(3).with_cages(2).with_turns(0..0);
    assert_eq!(layout.half(), 4 * 7 + 2 * 3);
    assert_eq!(layout.kind(BodyId::ball(2)), BodyKind::Ball(2));
    for row in 0..2 {
        let cage = layout.cage(row);
        assert_eq!(cage.index(), 5 + row);
        assert_eq!(layout.kind(cage), BodyKind::Cage(row));
        assert_eq!(layout.as_ball(cage), None);
        assert!(!layout.has(cage, Dof::TurnX) && layout.has(cage, Dof::Theta));
    }
    for (at, (body, dof)) in layout.degrees().enumerate() {
        assert_eq!(layout.at(body, dof), at);
    }
}

/// Truth: the order of `Model::names`.
#[test]
fn modes_stand_behind_the_cages() {
    let layout = Layout::of_balls(3)
        .with_cages(1)
        .with_modes(2)
        .with_turns(0..0);
    assert_eq!(layout.half(), 4 * 8 + 2 * 3);
    assert_eq!(layout.kind(layout.cage(0)), BodyKind::Cage(0));
    for mode in 0..2 {
        let body = layout.mode(mode);
        assert_eq!(
            (body.index(), layout.kind(body)),
            (6 + mode, BodyKind::Mode(mode))
        );
        assert_eq!(layout.as_ball(body), None);
        assert!(!layout.has(body, Dof::TurnX) && layout.has(body, Dof::X));
    }
    for (at, (body, dof)) in layout.degrees().enumerate() {
        assert_eq!(layout.at(body, dof), at);
    }
}
