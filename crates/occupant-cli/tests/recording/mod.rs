//! The result file: written by the recorder, read back by the public readers of MCAP and protobuf.

mod docs;
mod ends;
mod scenes;
mod support;
mod values;
