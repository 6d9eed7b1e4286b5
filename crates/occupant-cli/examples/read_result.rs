//! Reads one channel of a result file with nothing but public libraries: every channel carries its own schema.
//!
//! ```text
//! occupant run scenarios/cart-lap-torso.toml --output run.mcap
//! cargo run -p occupant-cli --example read_result -- run.mcap /occupant/segment/head accelerometer_resultant_m_s2
//! ```
#![allow(clippy::print_stdout, reason = "an example prints its result")]

use std::error::Error;

use mcap::{Channel, MessageStream};
use prost_reflect::{DescriptorPool, DynamicMessage, MessageDescriptor};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [file, topic, field] = &arguments[..] else { return Err("expected FILE TOPIC FIELD".into()) };
    let bytes = std::fs::read(file)?;

    let mut layout = None;
    let mut peak: Option<(f64, f64)> = None;
    for message in MessageStream::new(&bytes)? {
        let message = message?;
        if message.channel.topic != *topic {
            continue;
        }
        let layout = match &layout {
            Some(layout) => layout,
            None => layout.insert(layout_of(&message.channel)?),
        };
        let values = DynamicMessage::decode(layout.clone(), &message.data[..])?;
        let number = |name: &str| values.get_field_by_name(name).and_then(|value| value.as_f64());
        let time_s = number("time_s").ok_or("no time_s in this topic")?;
        let value = number(field).ok_or_else(|| format!("no number `{field}` in this topic"))?;
        if peak.is_none_or(|(greatest, _)| value > greatest) {
            peak = Some((value, time_s));
        }
    }
    let (value, time_s) = peak.ok_or_else(|| format!("no message of {topic}"))?;
    println!("{topic} {field}: greatest {value:.2} at {:.1} ms", 1e3 * time_s);
    Ok(())
}

/// The layout of a channel's messages, as the file itself describes it.
fn layout_of(channel: &Channel) -> Result<MessageDescriptor, Box<dyn Error>> {
    let schema = channel.schema.as_ref().ok_or("a channel without a schema")?;
    let pool = DescriptorPool::decode(&schema.data[..])?;
    pool.get_message_by_name(&schema.name).ok_or_else(|| "a schema without its own message".into())
}
