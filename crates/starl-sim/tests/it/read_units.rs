//! A quantity may be written in any of its units and means the same.

use crate::reading;

/// Sets a field and shows what the scenario then holds.
fn with(set: &str) -> starl_sim::Scenario {
    reading::read(reading::LEAST, &[set])
        .unwrap_or_else(|problems| panic!("{problems}"))
        .scenario
}

#[test]
fn durations() {
    for (text, nanoseconds) in [
        ("2s", 2_000_000_000),
        ("2 s", 2_000_000_000),
        ("1500ms", 1_500_000_000),
        ("1.5e3ms", 1_500_000_000),
        ("250us", 250_000),
        ("250µs", 250_000),
        ("7ns", 7),
        ("0.1s", 100_000_000),
        ("2min", 120_000_000_000),
        ("0.5h", 1_800_000_000_000),
        ("1_000s", 1_000_000_000_000),
    ] {
        assert_eq!(
            with(&format!("duration={text}")).duration.0,
            nanoseconds,
            "{text}"
        );
    }
}

#[test]
fn lengths_angles_and_speeds() {
    for text in ["0.33m", "330mm", "33cm", "0.00033km", "+330 mm"] {
        let range = with(&format!("network.range={text}")).network.range;
        assert_eq!(range, Some(0.33), "{text}");
    }
    let quarter = std::f64::consts::FRAC_PI_2;
    for text in ["90deg", "90°", "1.5707963267948966rad"] {
        let noise = with(&format!("positioning.heading_noise={text}"))
            .positioning
            .heading_noise;
        assert_eq!(noise, quarter, "{text}");
    }
    for text in ["0.25m/s", "250mm/s", "25cm/s", "0.9km/h"] {
        let noise = with(&format!("positioning.velocity_noise={text}"))
            .positioning
            .velocity_noise;
        assert_eq!(noise, 0.25, "{text}");
    }
}

#[test]
fn rates_ratios_and_probabilities() {
    for text in ["0.5/s", "30/min", "1800/h"] {
        assert_eq!(
            with(&format!("fault_rates.crash={text}"))
                .faults
                .rates
                .crash,
            0.5,
            "{text}"
        );
    }
    for text in ["0.2", "20%", "\"20 %\"", "2e-1"] {
        assert_eq!(
            with(&format!("network.loss={text}")).network.link.loss,
            0.2,
            "{text}"
        );
    }
    assert_eq!(
        with("robots.0.clock.drift=50ppm").fleet.groups[0]
            .clock
            .drift_ppm,
        50.0
    );
    assert_eq!(
        with("network.bandwidth=1Mbit/s").network.bandwidth,
        Some(1e6)
    );
    assert_eq!(with("network.bandwidth=unlimited").network.bandwidth, None);
    assert_eq!(
        with("network.delay=0").network.link.delay.0,
        0,
        "zero needs no unit"
    );
}

#[test]
fn points_in_metres_or_any_length() {
    let way_point = |position: &str| {
        let text = format!(
            "{}\n[[world.way_point]]\nname = \"A\"\nposition = {position}\n",
            reading::LEAST
        );
        reading::read(&text, &[]).unwrap().scenario.world.way_points[0].position
    };
    assert_eq!(way_point("[1, 2.5]"), starl_core::Point::planar(1.0, 2.5));
    assert_eq!(
        way_point("[\"100cm\", 2.5, \"5mm\"]"),
        starl_core::Point::new(1.0, 2.5, 0.005)
    );
}

#[test]
fn every_parameter_of_every_model_in_its_unit() {
    for kind in starl_motion::models::KINDS {
        let plain = starl_motion::models::by_name(kind.name).unwrap();
        for field in kind.fields {
            let unit = field.unit.replace("degrees", "deg");
            let text = format!(
                "program = \"race\"\n[[robots]]\nmodel = \"{}\"\nstart = [{{ position = [0, 0] }}]\n\
                 model_parameters = {{ {} = \"{}{unit}\" }}\n",
                kind.name, field.name, field.default
            );
            let read = reading::read(&text, &[]);
            let read = read
                .unwrap_or_else(|problems| panic!("{problems}"))
                .scenario;
            let model = &read.fleet.groups[0].model;
            assert_eq!(format!("{model:?}"), format!("{plain:?}"), "{}", field.name);
        }
    }
}

#[test]
fn parameters_of_models_in_other_units() {
    let with = |parameter: &str| {
        let set = format!("robots.0.model_parameters={{ {parameter} }}");
        let read = reading::read(reading::LEAST, &[&set]).unwrap().scenario;
        format!("{:?}", read.fleet.groups[0].model)
    };
    assert_eq!(with("radius = \"20cm\""), with("radius = \"0.2m\""));
    assert!(with("radius = \"20cm\"").contains("radius: 0.2,"));
    assert!(with("cruise_turn = \"1rad/s\"").contains("cruise_turn: 57.29577951308232,"));
}
