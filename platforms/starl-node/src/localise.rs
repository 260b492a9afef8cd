//! Localisation: an extended Kalman filter over odometry and external fixes.
//!
//! The state is the position in the floor plane and the heading; odometry moves it, fixes of an external system (motion
//! capture, a simulator) correct it. Odometry reports motion that is over, part of which a fix in between has seen
//! already. So when it comes, the state goes back to the measurement before, and takes the motion and the fixes in the
//! order of their times. Height is the last measured one. Between fixes the uncertainty grows with the
//! distance driven, as Thrun, Burgard and Fox describe it ("Probabilistic Robotics", 2005, chapter 5).

use crate::Reading;
use starl_core::math::wrap_angle;
use starl_core::{Estimate, Point, Pose, Time, Twist};
use std::collections::VecDeque;

/// How exact the sources are, standard deviations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accuracy {
    /// Of an external position, metres.
    pub position: f64,
    /// Of an external heading, radians.
    pub heading: f64,
    /// Of odometry, metres for each metre.
    pub way: f64,
    /// Of odometry, radians for each radian, and for each metre.
    pub turn: f64,
}

impl Default for Accuracy {
    fn default() -> Accuracy {
        Accuracy {
            position: 0.005,
            heading: 0.02,
            way: 0.05,
            turn: 0.05,
        }
    }
}

/// A fix this many standard deviations away is taken to be a glitch of the external system...
const GATE: f64 = 6.0;
/// ...but not if so many in a row say so, or if nothing was heard before for so long: then the robot was carried away.
const INSIST: u32 = 10;

/// At most so many fixes between two measurements of the robot's own are kept, the latest.
const MOST_SINCE: usize = 64;

/// A velocity is measured over about this long, seconds.
const SMOOTHING: f64 = 0.15;

/// The filter of one robot.
#[derive(Clone, Debug)]
pub struct Localiser {
    accuracy: Accuracy,
    /// Whether external fixes are expected: then odometry alone does not keep a position fresh for ever.
    has_fixes: bool,
    state: Option<State>,
    outliers: u32,
    /// The last measurement of the robot's own motion, and the fixes since.
    measured: Option<Measured>,
    since: VecDeque<(Time, Pose)>,
}

/// A measurement of the robot's own motion.
#[derive(Clone, Copy, Debug)]
struct Measured {
    at: Time,
    /// A belief since then, and its time: what was believed at the measurement, or, if the robot was carried away later,
    /// where it was found.
    belief: Belief,
    from: Time,
}

/// A pose and the covariance of its x, y and heading.
#[derive(Clone, Copy, Debug)]
struct Belief {
    pose: Pose,
    covariance: Matrix,
}

#[derive(Clone, Copy, Debug)]
struct State {
    belief: Belief,
    twist: Twist,
    /// When something was measured last that keeps the position fresh.
    fresh: Time,
    /// When a fix was taken last, and the pose then, for velocities of robots without odometry.
    fixed: Option<(Time, Pose)>,
    has_odometry: bool,
}

impl Localiser {
    /// A filter for a robot that starts at `start`, if that is known. With `has_fixes` an external system measures the
    /// position, and odometry only bridges its gaps.
    pub fn new(accuracy: Accuracy, start: Option<Pose>, has_fixes: bool, now: Time) -> Localiser {
        let state = start.map(|pose| State::at(pose, now, accuracy));
        Localiser {
            accuracy,
            has_fixes,
            state,
            outliers: 0,
            measured: None,
            since: VecDeque::new(),
        }
    }

    /// Adds the robot's own measurements.
    pub fn measure(&mut self, at: Time, reading: &Reading) {
        let accuracy = self.accuracy;
        let has_fixes = self.has_fixes;
        let Some(state) = &mut self.state else {
            return;
        };
        if reading.moved.is_some() || reading.turned.is_some() {
            let motion = Motion {
                moved: reading.moved.unwrap_or(Point::ZERO),
                turned: reading.turned.unwrap_or(0.0),
            };
            match self.measured {
                Some(last) if last.at < at => {
                    state.belief.go_back(&last.belief);
                    let whole = at.since(last.at).seconds();
                    let share = |time: Time| time.since(last.at).seconds() / whole;
                    let mut done = share(last.from).min(1.0);
                    for (time, pose) in self.since.drain(..) {
                        let until = share(time).clamp(done, 1.0);
                        state.belief.advance(motion.part(done, until), &accuracy);
                        state.correct(&pose, &accuracy);
                        done = until;
                    }
                    state.belief.advance(motion.part(done, 1.0), &accuracy);
                }
                _ => state.belief.advance(motion, &accuracy),
            }
            self.since.clear();
            self.measured = Some(Measured {
                at,
                belief: state.belief,
                from: at,
            });
            state.has_odometry = true;
            if !has_fixes {
                state.fresh = at;
            }
        }
        if let Some(height) = reading.height {
            state.belief.pose.position.z = height;
        }
        if let Some(velocity) = reading.velocity {
            let yaw = state.belief.pose.yaw;
            state.twist.linear = rotated(velocity, yaw);
        }
    }

    /// Adds a pose measured by an external system at `at`. Fixes older than the newest one are ignored, and so are
    /// glitches.
    pub fn fix(&mut self, at: Time, pose: Pose) {
        if !pose.position.is_finite() || !pose.yaw.is_finite() {
            return;
        }
        let accuracy = self.accuracy;
        let Some(state) = &mut self.state else {
            self.state = Some(State {
                fixed: Some((at, pose)),
                ..State::at(pose, at, accuracy)
            });
            return;
        };
        if state.fixed.is_some_and(|(last, _)| at <= last) {
            return;
        }
        if state.is_outlier(&pose, &accuracy) {
            self.outliers += 1;
            if self.outliers < INSIST {
                return;
            }
            *state = State {
                has_odometry: state.has_odometry,
                ..State::at(pose, at, accuracy)
            };
            // The belief before is wrong.
            self.measured = self.measured.map(|last| Measured {
                belief: state.belief,
                from: at.max(last.at),
                ..last
            });
            self.since.clear();
        } else {
            state.correct(&pose, &accuracy);
            match &mut self.measured {
                Some(last) if last.at < at => {
                    self.since.push_back((at, pose));
                    if self.since.len() > MOST_SINCE {
                        self.since.pop_front();
                    }
                }
                Some(last) => last.belief = state.belief,
                None => {}
            }
        }
        self.outliers = 0;
        state.belief.pose.position.z = pose.position.z;
        state.belief.pose.pitch = pose.pitch;
        state.belief.pose.roll = pose.roll;
        state.fresh = at;
        if !state.has_odometry {
            state.differentiate(at, &pose);
        }
        state.fixed = Some((at, pose));
    }

    /// Where the robot is, and when that was measured last; none if it was never known.
    pub fn estimate(&self) -> Option<(Estimate, Time)> {
        let state = self.state.as_ref()?;
        let estimate = Estimate {
            pose: state.belief.pose,
            twist: state.twist,
            ..Estimate::default()
        };
        Some((estimate, state.fresh))
    }

    /// Standard deviation of the position, metres.
    pub fn uncertainty(&self) -> f64 {
        self.state.as_ref().map_or(f64::INFINITY, |state| {
            let covariance = &state.belief.covariance;
            covariance[0][0].max(covariance[1][1]).sqrt()
        })
    }
}

/// The robot's measurement of its own motion: `moved` is in its frame before the turn.
#[derive(Clone, Copy, Debug)]
struct Motion {
    moved: Point,
    turned: f64,
}

impl Motion {
    /// The part between two shares of its time, at a constant speed on an arc; its frame is the one before this part.
    fn part(self, from: f64, to: f64) -> Motion {
        let share = to - from;
        // A chord lies half a turn beside the heading at its beginning.
        let beside = 0.5 * (share - 1.0) * self.turned;
        Motion {
            moved: rotated(self.moved * share, beside),
            turned: self.turned * share,
        }
    }
}

impl Belief {
    /// Takes over what was believed in the plane. Height and tilt stay: the latest measurement of them counts.
    fn go_back(&mut self, earlier: &Belief) {
        self.covariance = earlier.covariance;
        self.pose.position.x = earlier.pose.position.x;
        self.pose.position.y = earlier.pose.position.y;
        self.pose.yaw = earlier.pose.yaw;
    }

    fn advance(&mut self, Motion { moved, turned }: Motion, accuracy: &Accuracy) {
        let way = rotated(moved, self.pose.yaw);
        self.pose.position += way;
        self.pose.yaw = wrap_angle(self.pose.yaw + turned);
        // The Jacobian is the identity but for how the heading turns the way.
        let jacobian = [[1.0, 0.0, -way.y], [0.0, 1.0, way.x], [0.0, 0.0, 1.0]];
        let spread = product(
            &product(&jacobian, &self.covariance),
            &transposed(&jacobian),
        );
        self.covariance = spread;
        let length = way.planar_length();
        let along = (accuracy.way * length).powi(2);
        let turn = (accuracy.turn * turned).powi(2) + (accuracy.turn * length).powi(2);
        self.covariance[0][0] += along;
        self.covariance[1][1] += along;
        self.covariance[2][2] += turn;
    }
}

impl State {
    fn at(pose: Pose, now: Time, accuracy: Accuracy) -> State {
        let (p, h) = (accuracy.position.powi(2), accuracy.heading.powi(2));
        State {
            belief: Belief {
                pose,
                covariance: [[p, 0.0, 0.0], [0.0, p, 0.0], [0.0, 0.0, h]],
            },
            twist: Twist::default(),
            fresh: now,
            fixed: None,
            has_odometry: false,
        }
    }

    fn innovation(&self, pose: &Pose) -> [f64; 3] {
        let apart = pose.position - self.belief.pose.position;
        [
            apart.x,
            apart.y,
            wrap_angle(pose.yaw - self.belief.pose.yaw),
        ]
    }

    /// Covariance of a fix around the state, with something for the time that fixes take and motion between them.
    fn expected(&self, accuracy: &Accuracy) -> [[f64; 3]; 3] {
        let mut sum = self.belief.covariance;
        let slack = 0.1 * self.twist.linear.planar_length();
        sum[0][0] += accuracy.position.powi(2) + slack * slack;
        sum[1][1] += accuracy.position.powi(2) + slack * slack;
        sum[2][2] += accuracy.heading.powi(2);
        sum
    }

    fn is_outlier(&self, pose: &Pose, accuracy: &Accuracy) -> bool {
        // A robot without odometry may have gone anywhere since the last fix.
        if !self.has_odometry {
            return false;
        }
        let expected = self.expected(accuracy);
        let apart = self.innovation(pose);
        // A hand's width is not a glitch, whatever the filter estimates.
        (0..2).any(|i| apart[i].abs() > 0.1 && apart[i].powi(2) > GATE.powi(2) * expected[i][i])
    }

    fn correct(&mut self, pose: &Pose, accuracy: &Accuracy) {
        if !self.has_odometry {
            self.belief.pose = *pose;
            return;
        }
        let Some(inverse) = inverse(&self.expected(accuracy)) else {
            self.belief.pose = *pose;
            return;
        };
        let gain = product(&self.belief.covariance, &inverse);
        let apart = self.innovation(pose);
        let change: [f64; 3] = std::array::from_fn(|i| (0..3).map(|k| gain[i][k] * apart[k]).sum());
        self.belief.pose.position.x += change[0];
        self.belief.pose.position.y += change[1];
        self.belief.pose.yaw = wrap_angle(self.belief.pose.yaw + change[2]);
        let keep: [[f64; 3]; 3] =
            std::array::from_fn(|i| std::array::from_fn(|k| f64::from(i == k) - gain[i][k]));
        self.belief.covariance = product(&keep, &self.belief.covariance);
    }

    /// Velocity from one fix to the next, smoothed.
    fn differentiate(&mut self, at: Time, pose: &Pose) {
        let Some((last, before)) = self.fixed else {
            return;
        };
        let elapsed = at.since(last).seconds();
        if elapsed > 1.0 {
            self.twist = Twist::default();
            return;
        }
        let weight = elapsed / (elapsed + SMOOTHING);
        let linear = (pose.position - before.position) * (1.0 / elapsed);
        let yaw = wrap_angle(pose.yaw - before.yaw) / elapsed;
        self.twist.linear = self.twist.linear.lerp(linear, weight);
        self.twist.yaw += weight * (yaw - self.twist.yaw);
    }
}

/// A vector of the robot's frame in the world's.
fn rotated(vector: Point, yaw: f64) -> Point {
    let (sin, cos) = yaw.sin_cos();
    Point::new(
        vector.x * cos - vector.y * sin,
        vector.x * sin + vector.y * cos,
        vector.z,
    )
}

type Matrix = [[f64; 3]; 3];

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
}

fn transposed(a: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| a[j][i]))
}

/// By cofactors; none if the matrix has no inverse.
fn inverse(a: &Matrix) -> Option<Matrix> {
    let cofactor = |i: usize, j: usize| {
        let (r, s) = ((i + 1) % 3, (i + 2) % 3);
        let (p, q) = ((j + 1) % 3, (j + 2) % 3);
        a[r][p] * a[s][q] - a[r][q] * a[s][p]
    };
    let determinant: f64 = (0..3).map(|j| a[0][j] * cofactor(0, j)).sum();
    let is_regular = determinant.is_finite() && determinant.abs() > f64::MIN_POSITIVE;
    is_regular
        .then(|| std::array::from_fn(|i| std::array::from_fn(|j| cofactor(j, i) / determinant)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use starl_core::{Duration, Random};

    fn at(ms: u64) -> Time {
        Time::ZERO + Duration::from_millis(ms)
    }

    /// A robot that drove so far along an arc.
    fn odometry(driven: f64, turned: f64) -> Reading {
        let (sin, cos) = (turned / 2.0).sin_cos();
        Reading {
            moved: Some(Point::new(driven * cos, driven * sin, 0.0)),
            turned: Some(turned),
            ..Reading::default()
        }
    }

    /// Drives a circle of radius 1 with odometry that is 5 % off; gives the greatest distance from the truth.
    fn drive(fix_every: Option<u64>, noise: f64) -> f64 {
        let start = Pose::level(Point::new(1.0, 0.0, 0.0), std::f64::consts::FRAC_PI_2);
        let accuracy = Accuracy {
            position: noise.max(0.001),
            ..Accuracy::default()
        };
        let mut filter = Localiser::new(accuracy, Some(start), fix_every.is_some(), Time::ZERO);
        let mut random = Random::keyed(1, &[2]);
        let mut worst = 0.0_f64;
        for tick in 1..=1000u64 {
            let angle = tick as f64 * 0.01;
            filter.measure(at(50 * tick), &odometry(0.01 * 1.05, 0.01 * 1.02));
            let truth = Point::polar(1.0, angle);
            if fix_every.is_some_and(|every| tick % every == 0) {
                let noisy =
                    truth + Point::new(random.normal(0.0, noise), random.normal(0.0, noise), 0.0);
                let yaw = angle + std::f64::consts::FRAC_PI_2;
                filter.fix(at(50 * tick), Pose::level(noisy, yaw));
            }
            let (estimate, _) = filter.estimate().unwrap();
            worst = worst.max(estimate.pose.position.planar_distance(truth));
        }
        worst
    }

    #[test]
    fn fixes_keep_the_error_of_odometry_small() {
        let alone = drive(None, 0.0);
        let fixed = drive(Some(4), 0.005);
        assert!(alone > 0.1, "{alone}");
        assert!(fixed < 0.02, "{fixed}");
    }

    /// A robot whose odometry comes once a second drives an arc, and is seen by motion capture in between.
    #[test]
    fn odometry_is_not_added_to_fixes_that_have_seen_the_motion() {
        let start = Pose::level(Point::new(1.0, 0.0, 0.0), std::f64::consts::FRAC_PI_2);
        let mut filter = Localiser::new(Accuracy::default(), Some(start), true, Time::ZERO);
        filter.measure(at(0), &odometry(0.0, 0.0));
        let chord = 2.0 * 0.1_f64.sin();
        let mut worst = 0.0_f64;
        for tick in 1..=400u64 {
            let angle = tick as f64 * 0.01;
            let truth = Point::polar(1.0, angle);
            let now = at(50 * tick);
            filter.fix(now, Pose::level(truth, angle + std::f64::consts::FRAC_PI_2));
            if tick % 20 == 0 {
                filter.measure(now, &odometry(chord, 0.2));
                let (estimate, _) = filter.estimate().unwrap();
                worst = worst.max(estimate.pose.position.planar_distance(truth));
            }
        }
        assert!(worst < 0.005, "{worst} m");
    }

    /// A robot whose odometry comes once a second drives straight, and is carried away on its way.
    #[test]
    fn odometry_is_not_added_to_the_place_where_a_robot_that_was_carried_away_is_found() {
        let mut filter =
            Localiser::new(Accuracy::default(), Some(Pose::default()), true, Time::ZERO);
        filter.measure(at(0), &odometry(0.0, 0.0));
        for tick in 1..=80u64 {
            let driven = tick as f64 * 0.005;
            let carried = if tick > 60 { 3.0 } else { 0.0 };
            let truth = Point::planar(driven, carried);
            let now = at(50 * tick);
            // It is out of sight as soon as it is found.
            if tick <= 70 {
                filter.fix(now, Pose::level(truth, 0.0));
            }
            if tick % 20 == 0 {
                filter.measure(now, &odometry(0.1, 0.0));
                let (estimate, _) = filter.estimate().unwrap();
                let error = estimate.pose.position.planar_distance(truth);
                assert!(error < 0.01, "{error} m after {driven} m");
            }
        }
    }

    #[test]
    fn odometry_leaves_height_and_tilt_as_they_were_measured_last() {
        let mut filter = Localiser::new(Accuracy::default(), None, true, Time::ZERO);
        filter.fix(at(0), Pose::level(Point::ZERO, 0.0));
        filter.measure(at(10), &odometry(0.0, 0.0));
        let mut pose = Pose::level(Point::new(0.0, 0.0, 1.5), 0.0);
        pose.roll = 0.1;
        filter.fix(at(20), pose);
        filter.measure(at(30), &odometry(0.0, 0.0));
        let (estimate, _) = filter.estimate().unwrap();
        assert_eq!((estimate.pose.position.z, estimate.pose.roll), (1.5, 0.1));
        let climbed = Reading {
            height: Some(2.0),
            ..Reading::default()
        };
        filter.measure(at(40), &climbed);
        filter.measure(at(50), &odometry(0.0, 0.0));
        assert_eq!(filter.estimate().unwrap().0.pose.position.z, 2.0);
    }

    #[test]
    fn exact_odometry_needs_no_fixes() {
        let start = Pose::level(Point::new(1.0, 0.0, 0.0), std::f64::consts::FRAC_PI_2);
        let mut filter = Localiser::new(Accuracy::default(), Some(start), false, Time::ZERO);
        let chord = 2.0 * 0.005_f64.sin();
        for tick in 1..=1000u64 {
            filter.measure(at(50 * tick), &odometry(chord, 0.01));
            let (estimate, _) = filter.estimate().unwrap();
            let truth = Point::polar(1.0, tick as f64 * 0.01);
            let error = estimate.pose.position.planar_distance(truth);
            assert!(error < 1e-9, "{error} m after {tick} readings");
        }
    }

    #[test]
    fn a_glitch_is_ignored_and_a_robot_that_was_carried_away_is_found() {
        let mut filter = Localiser::new(Accuracy::default(), None, true, Time::ZERO);
        let here = Pose::level(Point::new(1.0, 1.0, 0.0), 0.0);
        let far = Pose::level(Point::new(4.0, 1.0, 0.0), 0.0);
        filter.fix(at(0), here);
        for tick in 1..50 {
            filter.measure(at(10 * tick), &odometry(0.0, 0.0));
            filter.fix(at(10 * tick), if tick == 20 { far } else { here });
            let x = filter.estimate().unwrap().0.pose.position.x;
            assert!((x - 1.0).abs() < 0.05, "{x}");
        }
        for tick in 50..70 {
            filter.measure(at(10 * tick), &odometry(0.0, 0.0));
            filter.fix(at(10 * tick), far);
        }
        assert!((filter.estimate().unwrap().0.pose.position.x - 4.0).abs() < 0.05);
    }

    #[test]
    fn a_position_ages_when_fixes_stop() {
        let mut filter = Localiser::new(Accuracy::default(), None, true, Time::ZERO);
        assert!(filter.estimate().is_none());
        filter.fix(at(100), Pose::level(Point::ZERO, 0.0));
        filter.measure(at(2000), &odometry(0.1, 0.0));
        assert_eq!(filter.estimate().unwrap().1, at(100));
    }

    #[test]
    fn velocity_is_measured_from_fixes_alone() {
        let mut filter = Localiser::new(Accuracy::default(), None, true, Time::ZERO);
        for tick in 0..100u32 {
            let x = 0.02 * f64::from(tick);
            let pose = Pose::level(Point::new(x, 0.0, 1.0), 0.0);
            filter.fix(at(20 * u64::from(tick)), pose);
        }
        let (estimate, _) = filter.estimate().unwrap();
        assert!((estimate.twist.linear.x - 1.0).abs() < 0.01, "{estimate:?}");
    }
}
