"""Checkpoints that somebody made or edited, that were cut short, and disks that are full: one sentence, at once."""

import errno
import hashlib
import json
import os
from base64 import b64encode
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from camkit import door_handle_study, nsga2
from camkit.search import checkpoint as module
from camkit.search.checkpoint import ARRAYS, WORST, read, remove_parts
from camkit.search.nsga2 import nsga2_steps

STUDY = door_handle_study()
SIZE = {"population": 8, "generations": 4, "seed": 1}
DAMAGED = "the checkpoint lift.search is damaged; delete it to begin anew"


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    path = tmp_path_factory.mktemp("written") / "lift.search"
    nsga2(STUDY, 8, 3, 1, path)
    return path.read_bytes()


@pytest.fixture
def kept(written, tmp_path):
    path = tmp_path / "lift.search"
    path.write_bytes(written)
    return path


def go_on(path):
    return nsga2(STUDY, **SIZE, checkpoint=path)


def test_what_was_written_is_read(kept):
    found = read(kept)
    again = kept.with_name("again.search")
    found.write(again)
    for name in ARRAYS:
        assert_array_equal(getattr(read(again), name), getattr(found, name))
    assert_array_equal(go_on(kept).x, nsga2(STUDY, **SIZE).x)


# ---------------------------------------------------------------- numbers that do not belong together


def edited(path, **changes):
    """As somebody would write it who knows how the digest is made."""
    replace(read(path), **changes).write(path)


def moved(path, name, i, j, by):
    array = getattr(read(path), name).copy()
    array[i, j] += by
    edited(path, **{name: array})


NUMBERS = {
    "a better objective": lambda path: moved(path, "f", 3, 0, -0.1),
    "an objective off by a billionth of itself": lambda path: moved(path, "f", 3, 0, 4e-9),
    "a limit that is not kept": lambda path: moved(path, "g", 3, 0, -0.5),
    "another design": lambda path: moved(path, "x", 3, 0, 1e-4),
    "a design below its bounds": lambda path: moved(path, "x", 3, 0, -1.0),
    "a design that is not a number": lambda path: moved(path, "x", 3, 0, np.nan),
    "an objective that is not a number": lambda path: moved(path, "f", 3, 0, np.nan),
    "an objective of nothing": lambda path: edited(path, f=np.full_like(read(path).f, WORST)),
    "a free value too few": lambda path: edited(path, x=read(path).x[:, :-1]),
    "an objective too few": lambda path: edited(path, f=read(path).f[:, :1]),
    "an objective too many": lambda path: edited(path, f=np.hstack([read(path).f, read(path).f])),
    "no limits": lambda path: edited(path, g=read(path).g[:, :0]),
    "a design too few": lambda path: edited(path, x=read(path).x[:-1]),
    "a rank too few": lambda path: edited(path, rank=read(path).rank[:-1]),
    "ranks in a square": lambda path: edited(path, rank=read(path).x),
    "a huge generation": lambda path: edited(path, number=10**4000),
    "a huge seed": lambda path: edited(path, seed=10**4000),
    "a negative seed": lambda path: edited(path, seed=-1),
    "a population that is a yes": lambda path: edited(path, population=True),
    "endless seconds": lambda path: edited(path, seconds=np.inf),
    "seconds that are not a number": lambda path: edited(path, seconds=np.nan),
    "a version that is a number": lambda path: edited(path, versions={"numpy": 2}),
    "a version of a thousand letters": lambda path: edited(path, versions={"numpy": "2" * 1000}),
    "an algorithm of a thousand letters": lambda path: edited(path, algorithm="A" * 1000),
    "a random state that is too large": lambda path: edited(path, random=state(path, state=2**128)),
    "a random state that is negative": lambda path: edited(path, random=state(path, state=-1)),
    "a random state of text": lambda path: edited(path, random=state(path, inc="1")),
    "a random state with more in it": lambda path: edited(path, random={**read(path).random, "more": deep(600)}),
    "versions that are nested": lambda path: edited(path, versions={"numpy": deep(600)}),
}


def state(path, **changes):
    random = dict(read(path).random)
    return {**random, "state": {**random["state"], **changes}}


def deep(levels):
    nested = 1
    for _ in range(levels):
        nested = [nested]
    return nested


@pytest.mark.parametrize("change", NUMBERS.values(), ids=NUMBERS)
def test_numbers_that_do_not_belong_together_are_damage(kept, change):
    change(kept)
    with pytest.raises(ValueError, match="is damaged") as refusal:
        go_on(kept)
    assert str(refusal.value) == DAMAGED


# ---------------------------------------------------------------- files that are built otherwise


def about(path):
    """What a file says, and what its numbers are."""
    return json.loads(path.read_text().partition("\n")[0])


def signed(path, text):
    """As somebody would write it who knows how the digest is made."""
    path.write_text(f"{text}\n{hashlib.sha256(text.encode()).hexdigest()}")


def said(**changes):
    return lambda path: signed(path, json.dumps({**about(path), **changes}))


def text(words):
    return lambda path: signed(path, words(path))


def by_hand(**changes):
    """The digest is the old one."""

    def change(path):
        _, _, digest = path.read_text().partition("\n")
        path.write_text(json.dumps({**about(path), **changes}) + "\n" + digest)

    return change


def without(name):
    return lambda path: signed(path, json.dumps({k: v for k, v in about(path).items() if k != name}))


def bytes_of(array):
    return b64encode(array.tobytes()).decode()


def table(path):
    return read(path).x


FILES = {
    "another seed, by hand": by_hand(seed=2),
    "no digest": lambda path: path.write_text(json.dumps(about(path))),
    "a digest of nothing": lambda path: path.write_text(json.dumps(about(path)) + "\n"),
    **{f"no {name}": without(name) for name in ("study", "population", "random", "versions", *ARRAYS)},
    "an array of numbers": lambda path: said(x=table(path).tolist())(path),
    "an array of nothing": said(x=None),
    "an array of text": said(x="1, 2, 3"),
    "letters that are none of base64": lambda path: said(x="*" + about(path)["x"])(path),
    "an array of half a number": lambda path: said(x=b64encode(table(path).tobytes()[:-4]).decode())(path),
    "an array of single precision": lambda path: said(x=bytes_of(table(path)[:, 0].astype("<f4")))(path),
    "an empty array": said(x=""),
    "a design too few": lambda path: said(x=bytes_of(table(path)[:-1]))(path),
    "a rank too many": lambda path: said(rank=bytes_of(np.ones(9)))(path),
    "a population of half": said(population=4),
    "a population of none": said(population=0),
    "a population that is to be found out": said(population=-1),
    "a population of text": said(population="8"),
    "more words": said(more=1),
    "words that are a method": said(write=1),
    "nested words": text(lambda path: "[" * 100_000),
    "nested words that end": said(more=deep(600)),
    "a huge whole number": text(lambda path: json.dumps(about(path)).replace('"seed": 1', '"seed": ' + "9" * 5000)),
    "a list": text(lambda path: "[]"),
    "no UTF-8": lambda path: path.write_bytes(b"\xff" + path.read_bytes()),
    "a zip archive": lambda path: np.savez(path.open("wb"), x=np.ones(3)),
}  # fmt: skip


@pytest.mark.parametrize("spoil", FILES.values(), ids=FILES)
def test_a_file_that_is_built_otherwise_is_damage(kept, spoil):
    spoil(kept)
    with pytest.raises(ValueError, match="lift") as refusal:
        go_on(kept)
    no_schema = "the file lift.search is no checkpoint of the schema 'camkit-checkpoint/3'"
    assert str(refusal.value) == (no_schema if spoil is FILES["a list"] else DAMAGED)


def test_a_file_that_is_cut_short_anywhere_is_damage(kept):
    whole = kept.read_bytes()
    for length in range(0, len(whole), 37):
        kept.write_bytes(whole[:length])
        with pytest.raises(ValueError, match=r"is damaged"):
            read(kept)


def test_a_flipped_bit_is_damage(kept):
    whole = kept.read_bytes()
    for place in np.random.default_rng(0).integers(0, 8 * len(whole), 400):
        content = bytearray(whole)
        content[place // 8] ^= 1 << place % 8
        kept.write_bytes(content)
        with pytest.raises(ValueError, match=r"is damaged|is no checkpoint of the schema"):
            read(kept)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes here")
def test_what_is_no_file_is_damage_and_nobody_waits(kept):
    kept.unlink()
    os.mkfifo(kept)
    with pytest.raises(ValueError, match="is damaged"):
        read(kept)
    kept.unlink()
    kept.mkdir()
    with pytest.raises(ValueError, match="is damaged"):
        read(kept)


def test_a_file_that_is_far_too_long_is_not_read(kept):
    with kept.open("r+b") as file:
        file.truncate(2**40)  # a hole: it takes no room
    with pytest.raises(ValueError, match="is damaged"):
        read(kept)


# ---------------------------------------------------------------- disks that are full, folders that vanish


def uninterrupted():
    return [g.evaluation.x.tolist() for g in nsga2_steps(STUDY, *SIZE.values())]


def test_a_full_disk_ends_no_search(kept, monkeypatch):
    """It goes on without the file, says so, and leaves the generation before whole."""
    before = read(kept).number
    full = OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    def half(path, content):
        with path.open("wb") as file:
            file.write(content[: len(content) // 2])
        raise full

    monkeypatch.setattr(Path, "write_bytes", half)
    with pytest.warns(RuntimeWarning) as told:
        front = go_on(kept)
    assert [str(warning.message) for warning in told] == [
        "the search goes on without the file lift.search: no space left on device"
    ]
    assert_array_equal(front.x, nsga2(STUDY, **SIZE).x)
    assert os.listdir(kept.parent) == ["lift.search"]
    assert read(kept).number == before


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="no /dev/full here")
def test_a_device_that_is_full_ends_no_search(tmp_path):
    """As the system says it: the file that is written beside leads to a full device."""
    part = tmp_path / f".lift.search.{os.getpid()}.part"
    search = nsga2_steps(STUDY, *SIZE.values(), tmp_path / "lift.search")
    next(search)
    part.symlink_to("/dev/full")
    told = [generation.message for generation in search]
    assert told == ["no space left on device"] * 3
    assert os.listdir(tmp_path) == ["lift.search"]


def test_a_folder_that_vanishes_ends_no_search(tmp_path):
    folder = tmp_path / "kept"
    folder.mkdir()
    found = []
    for generation in nsga2_steps(STUDY, *SIZE.values(), folder / "lift.search"):
        found.append(generation.evaluation.x.tolist())
        if generation.number == 2:
            (folder / "lift.search").unlink()
            folder.rmdir()
            assert generation.message == ""
        if generation.number > 2:
            assert generation.message == "no such file or directory"
    assert found == uninterrupted()


def test_a_search_that_is_too_large_to_be_read_is_not_written(kept, monkeypatch):
    found = read(kept)
    monkeypatch.setattr(module, "LARGEST", 1000)
    with pytest.raises(OSError, match="large"):
        found.write(kept)


def test_a_part_that_a_killed_process_left_is_removed(kept):
    """And nothing else: not another checkpoint's, and no name that happens to hold signs for many."""
    left = [kept.with_name(name) for name in (".lift.search.1.part", ".lift.search.99999.part")]
    others = [
        kept.with_name(name)
        for name in (".lift.search", ".lift2.search.1.part", "lift.search.1.part", ".l[i]ft.search.1.part")
    ]
    for path in (*left, *others):
        path.write_text("half")
    remove_parts(kept.with_name("l[i]ft.search"))
    assert left[0].exists()
    others[-1].write_text("half")
    go_on(kept)
    assert not any(path.exists() for path in left)
    assert all(path.exists() for path in others)
