# SPDX-License-Identifier: GPL-3.0-or-later
"""Damage inside an HDF5 file that hits what the file means: values where they lie, and datasets and attributes through the library."""
import io

import h5py
import numpy

import mutations


def value_changer(data):
    """A mutation that changes one number of one dataset in place. The places are looked up once, of the undamaged file."""
    places = []

    def visit(_, item):
        if isinstance(item, h5py.Dataset) and item.id.get_offset() is not None and item.size > 0:
            places.append((item.id.get_offset(), item.size, item.dtype))

    with h5py.File(io.BytesIO(data), "r") as file:
        file.visititems(visit)

    def dataset_value(content, draw):
        offset, count, kind = draw.choice(places)
        index = draw.choice([0, count - 1, draw.randrange(count), draw.randrange(count)])
        old = numpy.frombuffer(data, kind, count, offset)[index]
        with numpy.errstate(all="ignore"):
            if kind.kind == "f":
                new = draw.choice([*mutations.HOSTILE_DOUBLES, -old, old * (1 + 1e-6), old + 1, old * 1000])
                raw = numpy.array([new], "f8").astype(kind).tobytes()
            else:
                new = draw.choice([*mutations.HOSTILE_INTEGERS, int(old) + 1, int(old) - 1, int(old) * 2])
                raw = (new & (2**(8 * kind.itemsize) - 1)).to_bytes(kind.itemsize, "little")
        at = offset + index * kind.itemsize
        return content[:at] + raw + content[at + kind.itemsize:]

    return dataset_value


def _names(file):
    names = {h5py.Dataset: [], h5py.Group: []}
    file.visititems(lambda name, item: names[type(item)].append(name))
    return names[h5py.Dataset], names[h5py.Group]


def _new_dataset(file, name, draw):
    old = file[name]
    values, attributes = old[()], dict(old.attrs)
    how = draw.randrange(8)
    options = {}
    if how == 0:
        values = values[: draw.randrange(max(1, len(values)))] if values.ndim else values
    elif how == 1:
        values = values.astype(draw.choice(["f8", "f4", "i8", "i4", "u8", "u1", "i2", ">f8", ">i4"]))
    elif how == 2:
        values = values.reshape(values.shape + (1,))
    elif how == 3:
        values = numpy.zeros((0,) * values.ndim, values.dtype)
    elif how == 4:
        values = numpy.array([str(x) for x in values.flat][:1000], dtype="S12")
    elif how == 5:
        options = {"chunks": True, "compression": draw.choice(["gzip", None])}
    del file[name]
    with numpy.errstate(all="ignore"):
        if how == 6:  # a small chunk of a dataset that claims to be huge
            made = file.create_dataset(name, (draw.choice([2**20, 2**30, 2**60]),) + values.shape[1:], values.dtype,
                                       chunks=(64,) + tuple(max(1, n) for n in values.shape[1:]))
            if len(values) > 0:
                made[:min(64, len(values))] = values[:64]
        elif how == 7 and values.size > 0:
            made = file.create_dataset(name, values.shape, values.dtype, external=[("/dev/zero", 0, h5py.h5f.UNLIMITED)])
        else:
            made = file.create_dataset(name, data=values, **options)
    for key, value in attributes.items():
        made.attrs[key] = value


def changer(data, name, change):
    """A mutation through the library, of the undamaged file only: what others have damaged could bring the library down here."""
    def mutation(content, draw):
        if content != data:
            return mutations.flip_bits(content, draw)
        stream = io.BytesIO(content)
        with h5py.File(stream, "r+") as file:
            change(file, draw)
        return stream.getvalue()

    mutation.__name__ = name
    return mutation


def dataset_again(file, draw):
    """A dataset of another length, type, rank or layout, or none, or a group in its place."""
    datasets, _ = _names(file)
    name = draw.choice(datasets)
    if draw.random() < 0.2:
        del file[name]
        if draw.random() < 0.5:
            file.create_group(name)
    else:
        _new_dataset(file, name, draw)


def attribute_again(file, draw):
    """An attribute of another value or type, or none."""
    datasets, groups = _names(file)
    home = file[draw.choice(["/", *datasets, *groups, "frame", "provenance"])]
    if not home.attrs:
        home = file["provenance"]
    name = draw.choice(sorted(home.attrs))
    new = draw.choice([None, 1.0, float("nan"), -5, "", "word", "x" * 5000, numpy.bytes_(b"\xff\xfe"), numpy.array([1.0, float("inf"), 1e308]),
                       "9.9", "{}", "[" * 3000])
    del home.attrs[name]
    if new is not None:
        home.attrs[name] = new


def of_file(data):
    """The mutations for this file, weighted."""
    return ([value_changer(data)] * 10 + [changer(data, "dataset_again", dataset_again)] * 3 +
            [changer(data, "attribute_again", attribute_again)] * 3)
