"""Trains a model of gestures with scikit-learn on the board's own features, and judges it on people kept apart.

    python train_gestures.py train.npz train.csv gestures.model

The frames of all recordings lie one after the other in the .npz; the .csv names gesture and participant of each.
"""

from __future__ import annotations

import csv
import sys

import numpy as np
import taxel
from sklearn.linear_model import Ridge

PRESSED = 12  # counts: a cell above this is touched
PENALTY = 40.0  # of the planes' weights
FARTHEST = 2.5  # deviations from the mean that count, as on the board


def read(frames: str, labels: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Touches (recordings, frames, rows, columns), and the gesture and the person of each."""
    with np.load(frames) as arrays:
        (values,) = arrays.values()
    with open(labels, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    touches = values.astype(np.uint16).reshape(len(rows), -1, *values.shape[-2:])
    return touches, np.array([row["gesture"] for row in rows]), np.array([row["participant"] for row in rows])


def features(touch: np.ndarray) -> np.ndarray:
    """Features of a touch and of its halves, (3, 127): a gesture is the same when it is cut."""
    half = len(touch) // 2
    return np.array([taxel.features(part, pressed=PRESSED) for part in (touch, touch[:half], touch[half:])], float)


def train(examples: np.ndarray, gestures: np.ndarray, names: list[str]) -> taxel.TouchModel:
    """A plane for each gesture, nearest to 1 on its examples and to -1 on the others."""
    rows = examples.reshape(-1, examples.shape[-1])
    mean, scale = rows.mean(axis=0), rows.std(axis=0) + 1
    standard = np.clip((rows - mean) / scale, -FARTHEST, FARTHEST)
    targets = np.where(np.repeat(gestures, examples.shape[1])[:, None] == names, 1.0, -1.0)
    planes = Ridge(alpha=PENALTY * examples.shape[1]).fit(standard, targets)
    return taxel.TouchModel.linear(
        names, mean=mean, scale=scale, weights=planes.coef_, offsets=planes.intercept_, pressed=PRESSED
    )


def main(frames: str, labels: str, output: str) -> None:
    touches, gestures, people = read(frames, labels)
    names = sorted(set(gestures))
    examples = np.array([features(touch) for touch in touches])
    right = 0
    for person in sorted(set(people)):
        apart = people == person
        model = train(examples[~apart], gestures[~apart], names)
        right += sum(
            model.decide(touch).name == gesture for touch, gesture in zip(touches[apart], gestures[apart], strict=True)
        )
    print(f"{right} of {len(touches)} touches of people kept apart are right")
    train(examples, gestures, names).save(output, overwrite=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
