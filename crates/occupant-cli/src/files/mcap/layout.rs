//! A layout for Foxglove-compatible viewers: the scene beside the plots that a crash engineer looks at first. Viewers hide
//! three-dimensional topics until a layout shows them, so it travels with every file.

use occupant_core::model::Model;
use serde_json::{Value, json};

use super::topics::{self, VEHICLE_FRAME};

/// File name of the attachment.
pub(crate) const NAME: &str = "layout.json";

/// The layout; `belts` are the topics of the belts.
pub(crate) fn layout(model: &Model, belts: &[String]) -> Value {
    let head = "/occupant/segment/head.accelerometer_resultant_m_s2";
    let chest = "/occupant/segment/upper_torso.accelerometer_resultant_m_s2";
    let pelvis = "/occupant/segment/lower_torso.accelerometer_resultant_m_s2";
    let loops: Vec<String> = belts.iter().map(|b| format!("{b}.loop_force_n")).collect();
    let names = model.body().spheres.iter().map(|s| s.name.as_str());
    let forces: Vec<String> =
        topics::named(topics::SPHERES, names).iter().map(|t| format!("{t}.contact_force_resultant_n")).collect();
    let energies = ["kinetic_relative_j", "balance_j"].map(|f| format!("{}.{f}", topics::ENERGY));
    let panels = json!({
        "3D!scene": scene(),
        "Plot!accelerations": plot("Accelerometers, m/s²", &[head, chest, pelvis]),
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
        "layout": row(
            58,
            column(80, json!("3D!scene"), json!("RosOut!log")),
            column(
                50,
                column(50, json!("Plot!accelerations"), json!("Plot!belts")),
                column(50, json!("Plot!contacts"), json!("Plot!energy")),
            ),
        ),
    })
}

fn row(percent: u32, first: Value, second: Value) -> Value {
    json!({"direction": "row", "splitPercentage": percent, "first": first, "second": second})
}

fn column(percent: u32, first: Value, second: Value) -> Value {
    json!({"direction": "column", "splitPercentage": percent, "first": first, "second": second})
}

/// The camera follows the vehicle's place but keeps space's upright: the vehicle's Z points down.
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
            topics::BELTS_SCENE: {"visible": true},
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
