//! Recordings: contents, events in written order, and the messages of any topic.

use crate::error::{argument, raised};
use crate::event::{self, Fact, FactReader};
use crate::value;
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use serde_json::json;
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard, PoisonError};
use taxel::client::{Event, ImageNews};
use taxel::record::Play;
use taxel::recording::{BoardRecording, Messages, Overview};

/// Most by which messages are out of order in a recording, ns.
const DISORDER_NS: u64 = 10_000_000_000;

/// Contents of a recording: topics, times, attachments, metadata.
#[pyfunction]
pub fn overview(py: Python<'_>, path: PathBuf) -> PyResult<Bound<'_, PyDict>> {
    let found = py.detach(|| Overview::of(&BoardRecording::from(path).path)).map_err(raised)?;
    let topics: serde_json::Map<_, _> = found
        .channels
        .iter()
        .map(|info| {
            let channel = &info.channel;
            let count = found.counts.get(&channel.id).copied().unwrap_or(0);
            let reported =
                json!({ "encoding": channel.message_encoding, "schema": info.schema, "count": count });
            (channel.topic.clone(), reported)
        })
        .collect();
    let metadata: serde_json::Map<_, _> =
        found.metadata.iter().map(|some| (some.name.clone(), json!(some.metadata))).collect();
    let attachments: Vec<_> = found.attachments.iter().map(|some| some.name.clone()).collect();
    let [start, end] = found.stretch.unwrap_or_default();
    let all = json!({
        "topics": topics, "start_ns": start, "end_ns": end, "attachments": attachments, "metadata": metadata,
        "is_whole": found.torn.is_none(),
    });
    value::dict(py, &all)
}

/// An attachment of a recording; None if there is none of this name.
#[pyfunction]
pub fn attachment(py: Python<'_>, path: PathBuf, name: &str) -> PyResult<Option<Py<PyBytes>>> {
    let found =
        py.detach(|| Overview::of(&BoardRecording::from(path).path)?.attached(name)).map_err(raised)?;
    Ok(found.map(|bytes| PyBytes::new(py, &bytes).unbind()))
}

/// Range of log times, ns, both included.
#[derive(Debug, Clone, Copy)]
struct Range {
    first: u64,
    last: u64,
}

impl Range {
    fn has(self, time: u64) -> bool {
        (self.first..=self.last).contains(&time)
    }

    fn is_past(self, time: u64) -> bool {
        time > self.last.saturating_add(DISORDER_NS)
    }
}

/// Images by number: the board's times, us, the host's, ns, and the values by taxel.
type Images<'py> = (Bound<'py, PyArray1<u64>>, Bound<'py, PyArray1<u64>>, Bound<'py, PyArray2<u16>>);

/// The images of a range, or the raw codes. They are read into the memory of the array that is returned.
#[pyfunction]
pub fn images(py: Python<'_>, path: PathBuf, raw: bool, first: u64, last: u64) -> PyResult<Images<'_>> {
    let range = Range { first, last };
    let read = || -> anyhow::Result<_> {
        let recording = BoardRecording::from(path);
        recording.overview()?;
        let mut play = Play::open(&recording)?;
        let (mut times, mut hosts, mut values) = (Vec::new(), Vec::new(), Vec::new());
        while let Some((header, event)) = play.next_event()? {
            if range.is_past(header.log_time) {
                break;
            }
            let client = play.client();
            let (time, image) = match event {
                Event::Frame { time, image: ImageNews::Whole, .. } if !raw => {
                    (time, client.image().map_or(&[][..], |(_, image)| image))
                }
                Event::Raw { time, whole: true, .. } if raw => (time, client.raw()),
                _ => continue,
            };
            if !range.has(header.log_time) {
                continue;
            }
            if values.len() != times.len() * image.len() {
                return Err(
                    argument("images of another size follow: ask for a stretch of one garment").into()
                );
            }
            let host = client.host_time(time).map_or(header.log_time, |time| time.us.saturating_mul(1000));
            times.push(time.0);
            hosts.push(host);
            values.extend_from_slice(image);
        }
        values.shrink_to_fit();
        Ok((times, hosts, values))
    };
    let (times, hosts, values) = py.detach(read).map_err(raised)?;
    let shape = [times.len(), values.len() / times.len().max(1)];
    let values = PyArray1::from_vec(py, values).reshape(shape)?;
    Ok((PyArray1::from_vec(py, times), PyArray1::from_vec(py, hosts), values))
}

/// Iterator over the events of a recording.
#[pyclass(frozen, module = "taxel")]
pub struct RecordedEvents {
    kinds: Vec<String>,
    range: Range,
    play: Mutex<(Play, FactReader)>,
}

#[pymethods]
impl RecordedEvents {
    #[new]
    fn new(py: Python<'_>, path: PathBuf, kinds: Vec<String>, first: u64, last: u64) -> PyResult<Self> {
        let recording = BoardRecording::from(path);
        let open = || recording.overview().and_then(|_| Play::open(&recording));
        let play = py.detach(open).map_err(raised)?;
        let range = Range { first, last };
        Ok(RecordedEvents { kinds, range, play: Mutex::new((play, FactReader::default())) })
    }

    fn __iter__(slf: PyRef<'_, Self>) -> PyRef<'_, Self> {
        slf
    }

    fn __next__(&self, py: Python<'_>) -> PyResult<Option<Py<PyAny>>> {
        let fact = py.detach(|| self.next()).map_err(raised)?;
        fact.map(|fact| event::object(py, fact)).transpose()
    }
}

impl RecordedEvents {
    fn next(&self) -> anyhow::Result<Option<Fact>> {
        let (play, reader) = &mut *held(&self.play);
        while let Some((header, event)) = play.next_event()? {
            if self.range.is_past(header.log_time) {
                return Ok(None);
            }
            let fact = reader.fact(play.client(), &event, header.log_time);
            let kind = fact.line["type"].as_str().unwrap_or_default();
            let is_wanted = self.kinds.is_empty() || self.kinds.iter().any(|wanted| wanted == kind);
            if is_wanted && self.range.has(header.log_time) {
                return Ok(Some(fact));
            }
        }
        Ok(None)
    }
}

/// Iterator over the messages of a recording, as they were written.
#[pyclass(frozen, module = "taxel")]
pub struct RecordedMessages {
    topic: Option<String>,
    range: Range,
    messages: Mutex<Messages>,
}

/// A message: topic, log time and publish time in ns, data.
type MessageOf<Data> = (String, u64, u64, Data);

#[pymethods]
impl RecordedMessages {
    #[new]
    fn new(py: Python<'_>, path: PathBuf, topic: Option<String>, first: u64, last: u64) -> PyResult<Self> {
        let messages = py.detach(|| Messages::open(&BoardRecording::from(path).path)).map_err(raised)?;
        Ok(RecordedMessages { topic, range: Range { first, last }, messages: Mutex::new(messages) })
    }

    fn __iter__(slf: PyRef<'_, Self>) -> PyRef<'_, Self> {
        slf
    }

    fn __next__(&self, py: Python<'_>) -> PyResult<Option<MessageOf<Py<PyBytes>>>> {
        let found = py.detach(|| self.next()).map_err(raised)?;
        Ok(found.map(|(topic, log, publish, data)| (topic, log, publish, PyBytes::new(py, &data).unbind())))
    }
}

impl RecordedMessages {
    fn next(&self) -> anyhow::Result<Option<MessageOf<Vec<u8>>>> {
        let mut messages = held(&self.messages);
        while let Some(message) = messages.next_message()? {
            let (header, data) = (message.header, message.data.to_vec());
            if self.range.is_past(header.log_time) {
                return Ok(None);
            }
            let topic = messages.topic(header.channel_id).unwrap_or_default();
            let is_wanted = self.topic.as_deref().is_none_or(|wanted| wanted == topic);
            if is_wanted && self.range.has(header.log_time) {
                return Ok(Some((topic.to_string(), header.log_time, header.publish_time, data)));
            }
        }
        Ok(None)
    }
}

fn held<T>(of: &Mutex<T>) -> MutexGuard<'_, T> {
    of.lock().unwrap_or_else(PoisonError::into_inner)
}
