//! The sensors of robots, in the table `sensors` of a group.

use super::{Detector, Proximity, SensorSuite};
use crate::fields::field_table;
use crate::fields::schema::{Kind, LENGTH, SIZE};

field_table! {
    impl SensorSuite {
        /// Feels contacts.
        bumper: bool = Kind::Flag, Value("true");
        /// Measures distances along rays evenly round the body, the first straight ahead.
        proximity: Option<Proximity> = Kind::Switch(Proximity::FIELDS), Value("false");
        /// Sees things and robots in line of sight.
        detector: Option<Detector> = Kind::Switch(Detector::FIELDS), Value("false");
        /// Hidden obstacles this near to the body's edge and in line of sight become known. A robot that bumps into one
        /// knows it in any case.
        discovery_range: f64 = LENGTH, Value("600mm");
    }
}

field_table! {
    impl Proximity {
        /// The number of rays.
        rays: u32 = Kind::Count(1, 1024), Value("24");
        /// Their range beyond the body's edge.
        range: f64 = SIZE, Value("100mm");
    }
}

field_table! {
    impl Detector {
        /// The range, from the robot's centre.
        range: f64 = SIZE, Value("600mm");
    }
}
