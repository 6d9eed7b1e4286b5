//! A layout for Foxglove-compatible viewers: the scene beside the plots that a crash engineer looks at first. Viewers hide
//! three-dimensional topics until a layout shows them, so it travels with every file.

use crate::base::customary::{ACCELERATIONS, BALANCE, ENERGIES};
use occupant_core::results::catalogue::Message;
use serde_json::{Value, json};

use super::topics::{self, VEHICLE_FRAME};

/// File name of the attachment.
pub const NAME: &str = "layout.json";

/// A viewer layout for these messages.
pub fn layout(messages: &[Message]) -> Value {
    let fields = |message: &str, field: &str| -> Vec<String> {
        let own = messages.iter().filter(|m| m.name == message);
        own.map(|m| format!("{}.{field}", m.topic)).collect()
    };
    let segments = ACCELERATIONS.iter().map(|(channel, _)| channel.trim_end_matches(".acceleration.resultant"));
    let accelerometers: Vec<String> =
        segments.map(|segment| format!("/occupant/segment/{segment}.accelerometer_resultant_m_s2")).collect();
    let loops = fields("BeltState", "loop_force_n");
    let forces = fields("SphereLoad", "contact_force_resultant_n");
    let energy = |channel: &str| fields("EnergyLedger", &format!("{}_j", channel.trim_start_matches("energy.")));
    let energies = [ENERGIES[0], BALANCE[0]].map(|(channel, _)| energy(channel)).concat();
    let panels = json!({
        "3D!scene": scene(),
        "Plot!accelerations": plot("Accelerometers, m/s²", &accelerometers),
        "Plot!belts": plot("Belts, N", &loops),
        "Plot!contacts": plot("Contact forces, N", &forces),
        "Plot!energy": plot("Energy, J", &energies),
        "RosOut!log": {"searchTerms": [], "minLogLevel": 1, "topicToRender": topics::LOG},
    });
    json!({
        "configById": panels,
        "globalVariables": {},
        "userNodes": {},
        "playbackConfig": {"speed": 0.1},
        "layout": split("row", 58, split("column", 80, "3D!scene", "RosOut!log"), split("column", 50,
            split("column", 50, "Plot!accelerations", "Plot!belts"),
            split("column", 50, "Plot!contacts", "Plot!energy"),
        )),
    })
}

/// Two panels beside each other (`row`) or one below the other.
fn split(direction: &str, percent: u32, first: impl Into<Value>, second: impl Into<Value>) -> Value {
    let (first, second) = (first.into(), second.into());
    json!({"direction": direction, "splitPercentage": percent, "first": first, "second": second})
}

/// The camera follows the vehicle's position but stays upright in space: the vehicle's Z points down.
fn scene() -> Value {
    json!({
        "cameraState": {
            "perspective": true, "distance": 3.5, "phi": 75, "thetaOffset": 65, "fovy": 40, "near": 0.05, "far": 500,
            "target": [0, 0, 0], "targetOffset": [0, 0, 0], "targetOrientation": [0, 0, 0, 1],
        },
        "followMode": "follow-position",
        "followTf": VEHICLE_FRAME,
        "scene": {"backgroundColor": "#f4f4f6", "transforms": {"enablePreloading": true, "showLabel": false, "axisScale": 0}},
        "transforms": {},
        "layers": {},
        "topics": {
            topics::COMPARTMENT_SCENE: {"visible": true},
            topics::BODY_SCENE: {"visible": true},
            topics::SPHERES_SCENE: {"visible": false},
            topics::LINES_SCENE: {"visible": true},
            topics::FORCES_SCENE: {"visible": true},
            topics::LABELS_SCENE: {"visible": false},
        },
    })
}

fn plot(title: &str, paths: &[impl AsRef<str>]) -> Value {
    let path = |p: &str| json!({"value": p, "enabled": true, "timestampMethod": "receiveTime"});
    let paths: Vec<Value> = paths.iter().map(|p| path(p.as_ref())).collect();
    json!({
        "title": title, "paths": paths, "isSynced": true, "xAxisVal": "timestamp",
        "showLegend": true, "legendDisplay": "floating", "showXAxisLabels": true, "showYAxisLabels": true,
        "showPlotValuesInLegend": false, "sidebarDimension": 240,
    })
}
