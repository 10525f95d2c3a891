//! Requests to a board, as Python's `Requests` hands them over: by name, with named values.

use crate::error::argument;
use anyhow::{Result, bail, ensure};
use serde_json::Value;
use std::path::Path;
use taxel::client::{Client, SceneChange};
use taxel::session::setting;
use taxel::source::SceneFile;
use taxel_core::fold::{JOINTS, JointAngle, Posture};
use taxel_core::format::{Q15, name};
use taxel_core::gesture::ShippedModel;
use taxel_core::intent::Feed;
use taxel_core::wire::Request;

/// Values of a request.
struct Values(Value);

impl Values {
    /// A whole number from `least` to `most`.
    fn whole(&self, key: &str, least: i64, most: i64) -> Result<i64> {
        let found = self.0[key].as_i64().filter(|number| (least..=most).contains(number));
        let must = || argument(format!("{key} must be a whole number from {least} to {most}"));
        Ok(found.ok_or_else(must)?)
    }

    /// A number from -1 to 1.
    fn fraction(&self, key: &str) -> Result<Q15> {
        let found = self.0[key].as_f64().filter(|number| (-1.0..=1.0).contains(number));
        let found = found.ok_or_else(|| argument(format!("{key} must be a number from -1 to 1")))?;
        Ok(Q15((found * f64::from(Q15::ONE.0)).round() as i32))
    }

    fn text(&self, key: &str) -> &str {
        self.0[key].as_str().unwrap_or_default()
    }

    fn flag(&self, key: &str) -> bool {
        self.0[key].as_bool().unwrap_or(false)
    }
}

/// Queues the request of this name.
pub fn ask(client: &mut Client, request: &str, values: Value) -> Result<()> {
    let values = Values(values);
    let request = match request {
        "tare" => Request::Tare { frames: values.whole("frames", 1, 4096)? as u16 },
        "key_frame" => Request::KeyFrame,
        "self_test" => Request::SelfTest,
        "save" => Request::Save,
        "reset_settings" => Request::ResetSettings { undo: values.flag("undo") },
        "budget" => return Ok(client.stream_budget(values.whole("hz", 0, 65_535)? as u16)?),
        "set_raw" => return Ok(client.stream_raw(values.whole("hz", 0, 65_535)? as u16)?),
        "set_forms" => {
            let forms = Some((values.whole("in_frame", 0, 254)? as u8, values.flag("ages")));
            client.change_scene(SceneChange { forms, ..SceneChange::default() });
            return Ok(());
        }
        "set_concept" => Request::Feed(feed(&values)?),
        "set_posture" => Request::Posture(posture(client, &values)?),
        "set_gains" => return gains(client, &values),
        "set_body" => return Ok(setting::set_body(client, values.text("body"), values.text("garment"))?),
        "set_folds" => return Ok(setting::set_folds(client, Path::new(values.text("folds")))?),
        "set_poses" => return poses(client, &values),
        "set_pressing" => {
            client.change_scene(SceneChange::pressing(values.whole("hz", 0, 65_535)? as u16));
            return Ok(());
        }
        "set_garment" => return Ok(setting::set_garment(client, values.text("garment"))?),
        "set_scene" => return Ok(setting::set_scene(client, &SceneFile::named(values.text("scene"))?)?),
        "set_gestures" => return gestures(client, &values),
        _ => bail!(argument(format!("there is no request {request}"))),
    };
    Ok(client.request(&request)?)
}

fn feed(values: &Values) -> Result<Feed> {
    let concept = values.text("name");
    let short = name(concept);
    ensure!(
        !short.is_empty() && short == concept,
        argument(format!("{concept:?} is not a concept's name: 1 to 16 bytes"))
    );
    Ok(Feed {
        concept: short,
        value: values.fraction("value")?,
        age_ms: values.whole("age_ms", 0, u32::MAX.into())? as u32,
        timeout_ms: values.whole("timeout_ms", 0, u32::MAX.into())? as u32,
        default: values.fraction("default")?,
    })
}

/// Angles by the names of the scene's joints, degrees.
fn posture(client: &Client, values: &Values) -> Result<Posture> {
    let Some(description) = client.description() else {
        bail!(argument("the board's joints are known once its Hello has been read"));
    };
    let joints = &description.scene.joints;
    let mut posture = Posture::default();
    for (joint, degrees) in values.0["degrees"].as_object().into_iter().flatten() {
        let Some(index) = joints.iter().position(|known| known == joint.as_str()) else {
            let known: Vec<_> = joints.iter().map(|name| name.as_str()).collect();
            let known = if known.is_empty() { "none".into() } else { known.join(", ") };
            bail!(argument(format!("the scene has no joint {joint}; known: {known}")));
        };
        let angle = degrees.as_f64().filter(|angle| (-180.0..=180.0).contains(angle));
        let angle = angle.ok_or_else(|| argument(format!("{joint} must be -180 to 180 degrees")))?;
        let reported = JointAngle { joint: index as u8, centidegrees: (angle * 100.0).round() as i16 };
        let too_many = || argument(format!("a posture has at most {JOINTS} joints"));
        posture.joints.push(reported).map_err(|_| too_many())?;
    }
    Ok(posture)
}

/// Gains of all taxels, by number.
fn gains(client: &mut Client, values: &Values) -> Result<()> {
    let list = values.0["gains"].as_array().into_iter().flatten();
    let gain = |(taxel, value): (usize, &serde_json::Value)| {
        let gain = value.as_f64().filter(|gain| (0.0..16.0).contains(gain));
        let gain = gain.ok_or_else(|| argument(format!("the gain of taxel {taxel} must be 0 to 16")))?;
        Ok((gain * 4096.0).round().min(65_535.0) as u16)
    };
    let gains = list.enumerate().map(gain).collect::<Result<Vec<u16>>>()?;
    ensure!(gains.len() <= usize::from(u16::MAX), argument(format!("{} gains are too many", gains.len())));
    for (index, some) in gains.chunks(64).enumerate() {
        let gains = some.iter().copied().collect();
        client.request(&Request::SetGain { first: (64 * index) as u16, gains })?;
    }
    Ok(())
}

/// Poses by the names of links: three numbers, m, and a quaternion x, y, z, w.
fn poses(client: &mut Client, values: &Values) -> Result<()> {
    let numbers = |value: &serde_json::Value| -> Option<Vec<f64>> {
        value.as_array()?.iter().map(serde_json::Value::as_f64).collect()
    };
    let mut poses = Vec::new();
    for (link, pose) in values.0["poses"].as_object().into_iter().flatten() {
        let at: Option<[f64; 3]> = numbers(&pose[0]).and_then(|at| at.try_into().ok());
        let turn: Option<[f64; 4]> = numbers(&pose[1]).and_then(|turn| turn.try_into().ok());
        let what = || argument(format!("the pose of {link} must be three numbers and four numbers"));
        let (at, turn) = at.zip(turn).ok_or_else(what)?;
        poses.push((link.as_str(), at, turn));
    }
    Ok(setting::set_poses(client, poses)?)
}

fn gestures(client: &mut Client, values: &Values) -> Result<()> {
    let model = match values.0["model"].as_str() {
        None => {
            client.change_scene(SceneChange { gestures: Some(None), ..SceneChange::default() });
            return Ok(());
        }
        Some("gestures") => ShippedModel::Gestures,
        Some("intent") => ShippedModel::Intent,
        Some(other) => bail!(argument(format!(
            "there is no gesture model {other}; known are gestures and intent, and None for no model"
        ))),
    };
    let [gain, certainty] = ["gain", "certainty"].map(|key| values.0[key].as_f64());
    let config = setting::gestures(model, gain, certainty)?;
    client.change_scene(SceneChange { gestures: Some(Some(config)), ..SceneChange::default() });
    Ok(())
}
