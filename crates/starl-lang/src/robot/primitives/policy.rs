//! Policy in programs: a trained network, from a file beside the program.

use super::kind::{Attention, Kind, Member, query};
use crate::machine::List;
use crate::robot::arguments::Arguments;
use crate::robot::context::Context;
use crate::robot::instance::Instance;
use crate::robot::shape::Shape;
use alloc::borrow::Cow;
use alloc::format;
use alloc::vec::Vec;
use starl_core::Random;

/// The number of operations of a network that cost one unit of fuel; an instruction takes about as long.
const OPERATIONS_PER_FUEL: usize = 16;

/// A network of the program.
#[derive(Clone, Debug)]
pub struct Policy {
    /// Its number among the program's models.
    model: usize,
}

impl Kind for Policy {
    const NAME: &'static str = "Policy";

    const CONSTRUCTOR: &'static [Shape] = &[Shape::Text];

    const MEMBERS: &'static [Member<Policy>] = &[query(
        "evaluate",
        &[Shape::List(&Shape::Float)],
        Shape::List(&Shape::Float),
        |policy, context, call| {
            let numbers = Arguments::after_instance(call).object().list();
            let numbers = numbers.map_or(&[][..], List::scalars).iter();
            let input: Vec<f64> = numbers.map(|&bits| f64::from_bits(bits)).collect();
            let Some((path, network)) = context.code.model(policy.model) else {
                return Err("the program has no such model".into());
            };
            let (takes, given) = (network.inputs(), input.len());
            if given != takes {
                return Err(format!("`{path}` takes {takes} numbers, not {given}").into());
            }
            let mut output = Vec::new();
            network.evaluate(&input, &mut output);
            let bits = output.iter().map(|number| number.to_bits());
            call.set_object(0, List::of_scalars(bits.collect()).into());
            Ok((network.operations() / OPERATIONS_PER_FUEL) as u64)
        },
    )];

    const ATTENTION: Attention = Attention::NONE;

    fn bind(
        _: &Instance,
        context: &mut Context<'_, '_>,
        arguments: &mut Arguments<'_>,
    ) -> Result<Policy, Cow<'static, str>> {
        let path = arguments.text();
        let mut models = context.code.program().bytecode().models.iter();
        let found = models.position(|model| model.path == path);
        let model = found.ok_or_else(|| format!("the program has no model {path:?}"))?;
        Ok(Policy { model })
    }

    /// Its network is a part of the program, which no fault changes.
    fn corrupt(&mut self, _: &mut Random) {}
}
