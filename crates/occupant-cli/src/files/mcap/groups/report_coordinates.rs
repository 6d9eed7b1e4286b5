//! The report's generalized coordinates, on request.

use crate::files::mcap::column::{Group, TIME, Value, column};
use Value::Coordinates;

/// Message `occupant.ReportCoordinates`.
pub(crate) const REPORT_COORDINATES: Group = Group {
    message: "ReportCoordinates",
    columns: &[
        TIME,
        column(
            2,
            "q_m_or_rad",
            Coordinates(|s| s.report_coordinates().q),
            "q1 to q31 in the report's order: q1 to q3 in m, the angles in rad",
        ),
        column(3, "q_rate_m_s_or_rad_s", Coordinates(|s| s.report_coordinates().rates), "their rates"),
    ],
};
