//! A body among solids.

use occupant_core::model::Model;
use occupant_core::model::setup::Setup;
use occupant_core::results::checkpoint::Checkpoint;
use occupant_core::results::outcome::{Outcome, Status};
use occupant_core::results::recorder::{Flow, Recorder, RecorderError};
use occupant_core::results::sample::Sample;
use occupant_core::run::batch::{Ended, Job, Kernel, simulate_many};
use occupant_core::run::simulate::simulate;
use occupant_scenario::{Draft, Format};
use std::ops::ControlFlow;

const ROOM: &str = include_str!("../data/room.toml");

/// Error control that is finer than the default.
pub const FINE: &str = "integrator={ kind = \"adaptive\", relative = 3e-8 }";

/// The text of a scenario with these assignments as plain data.
pub fn setup(text: &str, set: &[&str]) -> Setup {
    let mut draft = Draft::read(text, Format::Toml, "test").unwrap();
    set.iter().for_each(|assignment| draft.set(assignment).unwrap());
    let no_files = |name: &str| Err(format!("no file {name}"));
    draft.load(&no_files).and_then(|loaded| loaded.build()).unwrap().0
}

/// A run to its end.
pub fn run(setup: Setup, mut recorder: impl Recorder) -> (Model, Outcome) {
    let model = Model::new(setup).unwrap();
    let outcome = simulate(&model, &mut recorder).unwrap();
    assert_eq!(outcome.status, Status::Completed);
    (model, outcome)
}

/// A body that falls tumbling through a room of twenty solids, with these assignments.
pub fn room(set: &[&str]) -> Setup {
    setup(ROOM, set)
}

/// Runs five models, numbered from 0, alone and in every kind of lanes that the processor has: all must end in the same bits.
pub fn ends_alike_side_by_side(model: impl Fn(u32) -> Model) {
    let models = || (0..5).map(&model);
    let last_alone = |model: Model| {
        let mut last = Last::default();
        simulate(&model, &mut last).unwrap();
        last.0
    };
    let alone: Vec<_> = models().map(last_alone).collect();
    for kernel in [Kernel::Lanes4, Kernel::Lanes8].into_iter().filter(|kernel| kernel.is_available()) {
        let jobs = models().enumerate().map(|(tag, model)| Job { tag, model, recorder: Last::default() });
        let mut in_lanes = 0;
        simulate_many(kernel, jobs, |ended: Ended<usize, Last>| {
            assert!(ended.recorder.0 == alone[ended.tag], "run {} has other bits", ended.tag);
            in_lanes += usize::from(ended.kernel == kernel);
            ControlFlow::Continue(())
        });
        assert!(in_lanes >= 4, "{in_lanes}");
    }
}

/// Keeps the last checkpoint.
#[derive(Default)]
pub struct Last(pub Option<Checkpoint>);

impl Recorder for Last {
    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        self.0 = Some(sample.checkpoint());
        Ok(Flow::Continue)
    }
}

/// Webbing `strap` and retractor `reel`, whose spool pulls with a constant tension and never locks.
pub const PULLED: &str = r#"
[webbings.strap]
strain = [0, 0.1]
force = [0, 11000]

[triggers.never]
kind = "time"
at = "9 s"

[retractors.reel]
on_spool = "2 m"
spool_tension = "2 kN"
lock = { trigger = "never", payout = 0 }
"#;
