//! Models are found by name and take their parameters by name; what does not fit is named.

use starl_motion::models::{self, Car, CarParameters, Create, CreateParameters};
use starl_motion::{Model, ParameterError};

fn with(model: &str, settings: &[(&str, f64)]) -> Result<std::sync::Arc<dyn Model>, String> {
    let settings: Vec<_> = settings
        .iter()
        .map(|(name, value)| ((*name).into(), *value))
        .collect();
    models::with_parameters(model, &settings).map_err(|error| error.to_string())
}

#[test]
fn every_model_is_found_by_its_name_and_its_defaults_are_valid() {
    for (name, summary) in models::NAMES {
        assert_eq!(models::by_name(name).expect(name).name(), name);
        assert!(!summary.is_empty());
    }
    assert!(models::by_name("submarine").is_none());
}

#[test]
fn every_parameter_of_every_model_can_be_set() {
    for kind in models::KINDS {
        assert!(!kind.fields.is_empty());
        for field in kind.fields {
            assert!(
                field.low <= field.default && field.default <= field.high,
                "{field:?}"
            );
            with(kind.name, &[(field.name, field.default)]).expect(field.name);
            for outside in [
                field.low - 1.0,
                field.high * 1.01 + 1.0,
                f64::NAN,
                f64::INFINITY,
            ] {
                let error = with(kind.name, &[(field.name, outside)]).expect_err(field.name);
                assert!(error.contains(field.name), "{error}");
            }
        }
    }
}

#[test]
fn parameters_take_effect() {
    let create = with("create", &[("radius", 0.2), ("cruise_speed", 0.4)]).unwrap();
    assert_eq!(create.body().radius, 0.2);
    assert_eq!(create.limits().cruise_speed, 0.4);
    let own = Create::new(CreateParameters {
        radius: 0.2,
        ..CreateParameters::default()
    })
    .unwrap();
    assert_eq!(own.body().radius, 0.2);
    let wide = with("car", &[("steering_angle", 10.0)]).unwrap();
    assert!(wide.limits().turn_radius > 2.0 * Car::default().limits().turn_radius);
}

#[test]
fn errors_name_the_problem_and_the_accepted_values() {
    let message = |result: Result<_, String>| result.map(|_| ()).unwrap_err();
    assert_eq!(
        message(with("submarine", &[])),
        "there is no robot model `submarine`; the models are `create`, `drone`, `car`, \
         `holonomic`, `differential`"
    );
    assert_eq!(
        message(with("differential", &[("radios", 1.0)])),
        "model `differential` has no parameter `radios`; it has `radius`, `height`, \
         `wheel_distance`, `wheel_speed`, `cruise_speed`"
    );
    assert_eq!(
        message(with("create", &[("radius", -1.0)])),
        "`radius` is -1, but must be 0.01 to 10 m"
    );
    assert_eq!(
        message(with("create", &[("cruise_speed", 0.6)])),
        "`cruise_speed` must not exceed `wheel_speed`"
    );
    let inconsistent = CarParameters {
        cruise_speed: 9.0,
        ..CarParameters::default()
    };
    assert!(matches!(
        Car::new(inconsistent),
        Err(ParameterError::Inconsistent { .. })
    ));
}
