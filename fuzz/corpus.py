"""The corpus of a target is one archive, fuzz/corpus/TARGET.tar.xz. The same inputs give the same bytes."""
import io
import pathlib
import tarfile

CORPUS = pathlib.Path(__file__).resolve().parent / "corpus"


def targets():
    return sorted(path.name.removesuffix(".tar.xz") for path in CORPUS.glob("*.tar.xz"))


def archive(target):
    return CORPUS / f"{target}.tar.xz"


def read(target):
    """The inputs of a target by name; none if it has no archive yet."""
    if not archive(target).exists():
        return {}
    with tarfile.open(archive(target)) as tar:
        return {member.name: tar.extractfile(member).read() for member in tar if member.isfile()}


def write(target, inputs):
    """Replaces the archive of a target. `inputs`: bytes by name."""
    CORPUS.mkdir(exist_ok=True)
    with tarfile.open(archive(target), "w:xz", preset=9, format=tarfile.USTAR_FORMAT) as tar:
        for name in sorted(inputs):
            member = tarfile.TarInfo(name)  # no time and no owner
            member.size = len(inputs[name])
            tar.addfile(member, io.BytesIO(inputs[name]))


def unpack(target, folder):
    """Makes `folder` hold the inputs of a target and nothing else."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.iterdir():
        old.unlink()
    for name, data in read(target).items():
        (folder / name).write_bytes(data)


def pack(target, folder):
    write(target, {path.name: path.read_bytes() for path in pathlib.Path(folder).iterdir()})
