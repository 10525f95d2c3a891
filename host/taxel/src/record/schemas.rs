//! JSON schemas of the messages, so that Foxglove and others can offer the fields before any message. They
//! are derived from the messages' structs; a test compares them.

macro_rules! schema {
    ($topic:literal) => {
        ($topic, include_str!(concat!("../../schemas/messages/", $topic, ".json")))
    };
}

/// A topic with JSON messages: its name below `/taxel/`, and their schema.
pub type JsonTopic = (&'static str, &'static str);

/// All JSON topics.
pub const JSON: [JsonTopic; 21] = [
    schema!("hello"),
    schema!("frames"),
    schema!("contacts"),
    schema!("symbols"),
    schema!("intent"),
    schema!("reactions"),
    schema!("health"),
    schema!("health_map"),
    schema!("budget"),
    schema!("temperature"),
    schema!("gestures"),
    schema!("self_test"),
    schema!("posture"),
    schema!("log"),
    schema!("pressing"),
    schema!("joints"),
    schema!("poses"),
    schema!("regions"),
    schema!("lost"),
    schema!("back"),
    schema!("other"),
];

/// The schemas as the structs give them, in the order of [`JSON`]: as programs for recordings want them, and
/// as they are.
#[cfg(feature = "schema")]
pub fn derived() -> [[serde_json::Value; 2]; 21] {
    use super::contacts_message::ContactsMessage;
    use super::message::{FrameMessage, JointsLine, PosesLine, PostureLine};
    use crate::json::HostTimed;
    use crate::json::lines::{
        BackLine, BudgetLine, GestureLine, HealthLine, HealthMapLine, HelloLine, IntentLine, LogLine,
        LostLine, OtherLine, PressingLine, ReactionLine, RegionsLine, SelfTestLine, SymbolsLine,
        TemperatureLine,
    };
    use crate::json::schema::{of, plain};
    use schemars::JsonSchema;
    use serde_json::Value;
    fn both<T: JsonSchema>() -> [Value; 2] {
        [plain::<T>(), of::<T>()]
    }
    /// With the host's time; the description is that of the message.
    fn timed<T: JsonSchema>() -> [Value; 2] {
        let described = of::<T>()["description"].take();
        both::<HostTimed<T>>().map(|mut schema| {
            schema["description"] = described.clone();
            schema
        })
    }
    [
        timed::<HelloLine<'static>>(),
        timed::<FrameMessage>(),
        timed::<ContactsMessage<'static>>(),
        timed::<SymbolsLine<'static>>(),
        timed::<IntentLine>(),
        timed::<ReactionLine<'static>>(),
        timed::<HealthLine>(),
        timed::<HealthMapLine>(),
        timed::<BudgetLine>(),
        timed::<TemperatureLine>(),
        timed::<GestureLine<'static>>(),
        timed::<SelfTestLine<'static>>(),
        timed::<PostureLine<'static>>(),
        timed::<LogLine<'static>>(),
        timed::<PressingLine<'static>>(),
        timed::<JointsLine<'static>>(),
        timed::<PosesLine<'static>>(),
        timed::<RegionsLine<'static>>(),
        timed::<LostLine<'static>>(),
        timed::<BackLine<'static>>(),
        timed::<OtherLine<'static>>(),
    ]
}
