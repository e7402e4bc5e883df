//! Drive, loads and values in time.

use super::check::{entry_name, finite, numbers, within};
use crate::base::error::{Error, Result};
use crate::base::quantities;
use crate::scene::{Drive, Load, Profile, Scene, TableForce, TimeFunction};

/// Check of what turns the rings.
pub(super) fn drive(scene: &Scene) -> Result<()> {
    if let Some(speed) = &scene.outer_speed {
        ring_speed("outer_speed", speed)?;
    }
    match &scene.drive {
        Drive::Speed(speed) => ring_speed("drive.speed", speed),
        Drive::Torque { value, .. } => {
            time_function("drive.torque.value", value, 1e12, "N m")?;
            numbers("drive.torque", scene.drive.numbers())
        }
    }
}

/// The given speed of a ring.
fn ring_speed(path: &str, speed: &TimeFunction) -> Result<()> {
    time_function(path, speed, 1e6, "rad/s")?;
    let jumps = match speed {
        TimeFunction::Profile(Profile::Ramp { start, end, .. }) => start == end,
        TimeFunction::Profile(Profile::Table { times, .. }) => {
            times.windows(2).any(|pair| pair[0] == pair[1])
        }
        _ => false,
    };
    if jumps {
        return Err(Error::scene(
            path,
            "a jump",
            "a speed without jumps (a ramp that ends after its start, a table whose times increase)",
        ));
    }
    Ok(())
}

pub(super) fn loads(scene: &Scene) -> Result<()> {
    for (name, load) in &scene.loads {
        entry_name("loads", name)?;
        let Load {
            ring: _,
            direction: along,
            force,
            // `tilt` checks the place.
            at: _,
        } = load;
        direction(&format!("loads.{name}"), along)?;
        time_function(&format!("loads.{name}.force"), force, 1e12, "N")?;
    }
    for (name, table) in &scene.table_forces {
        entry_name("table_forces", name)?;
        table_force(&format!("table_forces.{name}"), table)?;
    }
    unbalances(scene)
}

fn table_force(path: &str, table: &TableForce) -> Result<()> {
    let TableForce { places, forces, .. } = table;
    direction(path, &table.direction)?;
    numbers(path, table.numbers())?;
    let rises = places.windows(2).all(|pair| pair[0] < pair[1]);
    if places.len() < 2 || !rises {
        let allowed = "two or more numbers, each above the one before";
        return Err(Error::scene(
            format!("{path}.places"),
            format!("{places:?}"),
            allowed,
        ));
    }
    if forces.len() != places.len() {
        return Err(Error::scene(
            format!("{path}.forces"),
            format!("{} numbers", forces.len()),
            format!("one for each of the {} places", places.len()),
        ));
    }
    Ok(())
}

/// Check of the direction along which a load acts, or about which a moment does.
pub(super) fn direction(path: &str, direction: &[f64; 3]) -> Result<()> {
    let size = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
    if size.is_finite() && size > 0.0 {
        return Ok(());
    }
    Err(Error::scene(
        format!("{path}.direction"),
        format!("{direction:?}"),
        "three finite numbers, not all zero",
    ))
}

fn unbalances(scene: &Scene) -> Result<()> {
    for (name, unbalance) in &scene.unbalances {
        entry_name("unbalances", name)?;
        numbers(&format!("unbalances.{name}"), unbalance.numbers())?;
    }
    Ok(())
}

pub(super) fn time_function(
    path: &str,
    value: &TimeFunction,
    limit: f64,
    unit: &str,
) -> Result<()> {
    let each = |field: &str, x: f64| within(&format!("{path}{field}"), x, -limit..=limit, unit);
    match value {
        TimeFunction::Constant(x) => each("", *x),
        TimeFunction::Profile(Profile::Ramp {
            from,
            to,
            start,
            end,
        }) => {
            each(".ramp.from", *from)?;
            each(".ramp.to", *to)?;
            finite(&format!("{path}.ramp.start"), *start)?;
            finite(&format!("{path}.ramp.end"), *end)?;
            if end < start {
                return Err(Error::scene(
                    format!("{path}.ramp.end"),
                    end,
                    format!("at least start, {}", quantities::duration(*start)),
                ));
            }
            Ok(())
        }
        TimeFunction::Profile(Profile::Sine {
            mean,
            amplitude,
            frequency,
            phase,
        }) => {
            each(".sine.mean", *mean)?;
            each(".sine.amplitude", *amplitude)?;
            within(
                &format!("{path}.sine.frequency"),
                *frequency,
                0.0..=1e9,
                "Hz",
            )?;
            finite(&format!("{path}.sine.phase"), *phase)
        }
        TimeFunction::Profile(Profile::Table { times, values }) => {
            if times.is_empty() || times.len() != values.len() {
                return Err(Error::scene(
                    format!("{path}.table"),
                    format!("{} times, {} values", times.len(), values.len()),
                    "as many values as times, at least one",
                ));
            }
            let is_bad = |(t, x): (&f64, &f64)| !(t.is_finite() && (-limit..=limit).contains(x));
            // Its path is written only for one that is refused: tables may have 10⁵ points.
            if let Some(i) = times.iter().zip(values).position(is_bad) {
                let (t, x) = (&times[i], &values[i]);
                finite(&format!("{path}.table.times[{i}]"), *t)?;
                each(&format!(".table.values[{i}]"), *x)?;
            }
            match times.windows(2).position(|pair| pair[1] < pair[0]) {
                Some(i) => Err(Error::scene(
                    format!("{path}.table.times[{}]", i + 1),
                    times[i + 1],
                    format!(
                        "at least the time before it, {}",
                        quantities::duration(times[i])
                    ),
                )),
                None => Ok(()),
            }
        }
        TimeFunction::Profile(Profile::Spline {
            times,
            values,
            rates,
        }) => {
            let counts = [times.len(), values.len(), rates.len()];
            if times.is_empty() || counts != [times.len(); 3] {
                let [times, values, rates] = counts;
                return Err(Error::scene(
                    format!("{path}.spline"),
                    format!("{times} times, {values} values, {rates} rates"),
                    "as many values and rates as times, at least one",
                ));
            }
            for (i, t) in times.iter().enumerate() {
                finite(&format!("{path}.spline.times[{i}]"), *t)?;
                each(&format!(".spline.values[{i}]"), values[i])?;
                finite(&format!("{path}.spline.rates[{i}]"), rates[i])?;
            }
            match times.windows(2).position(|pair| pair[1] <= pair[0]) {
                Some(i) => Err(Error::scene(
                    format!("{path}.spline.times[{}]", i + 1),
                    times[i + 1],
                    format!(
                        "later than the time before it, {}",
                        quantities::duration(times[i])
                    ),
                )),
                // Between points it may be further than at any of them.
                None => value
                    .range()
                    .into_iter()
                    .try_for_each(|x| each(".spline", x)),
            }
        }
    }
}
