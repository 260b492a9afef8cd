//! A scenario that says nothing has the defaults that the data types document.

use crate::reading;
use starl_sim::Scenario;
use starl_sim::scenario::{Clock, SensorSuite};

#[test]
fn omitted_fields_have_their_defaults() {
    let read = reading::read(reading::LEAST, &[]).unwrap().scenario;
    let mut expected = Scenario {
        title: "run".to_string(),
        ..Scenario::default()
    };
    // These two follow the fleet and the positioning system.
    let avoidance = expected.motion.avoidance.as_mut().unwrap();
    avoidance.largest_radius = 0.165;
    assert_eq!(avoidance.period, read.positioning.period.seconds());
    expected.fleet = read.fleet.clone();
    assert_eq!(format!("{read:#?}"), format!("{expected:#?}"));

    let group = &read.fleet.groups[0];
    assert_eq!(group.sensors, SensorSuite::default());
    assert_eq!(group.clock, Clock::default());
    assert_eq!(group.control_period.seconds(), 0.1);
    assert_eq!(
        (group.name.as_str(), group.numbered, group.first_number),
        ("create", true, 0)
    );
}

#[test]
fn sensors_switched_on_have_their_defaults() {
    let on = [
        "robots.0.sensors.proximity=true",
        "robots.0.sensors.detector={}",
    ];
    let read = reading::read(reading::LEAST, &on).unwrap().scenario;
    let sensors = read.fleet.groups[0].sensors;
    let proximity = sensors.proximity.unwrap();
    assert_eq!((proximity.rays, proximity.range), (24, 0.1));
    assert_eq!(sensors.detector.unwrap().range, 0.6);
}
