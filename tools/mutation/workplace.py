"""Folders in which mutants are built, each a copy of the sources and one build folder of its own."""

import contextlib
import hashlib
import os
import shutil
import subprocess

# What decides whether a result still holds; no document and no script.
CODE = ("CMakeLists.txt", "cmake/", "engine/", "include/", "passes/", "shaders/", "tools/")
NO_CODE = ("tools/mutation/", "tools/scripts/")
TESTS = ("tests/",)
# As the tests are run, but file by file, so that a mistake costs one compilation, and with what
# release builds leave out.
OPTIONS = (
    "--preset", "release",
    "-DCMAKE_UNITY_BUILD=OFF",
    "-DNEARFIELD_SHADER_RELOAD=ON",
    "-DNEARFIELD_BUILD_EXAMPLES=OFF",
)


def folder_of(root):
    return root / "build" / "mutants"


class Workplace:
    """Nothing outside of its folder is written to, so the user's sources stay as they are."""

    def __init__(self, root, number):
        self.root = root
        self.folder = folder_of(root) / str(number)
        self.source = self.folder / "source"
        # As deep as a build folder of the user, so that a compiler cache knows what that one has.
        self.build = self.source / "build" / "mutants"
        # Files of the copy are not to be taken for files of the repository around it.
        self.environment = os.environ | {"GIT_CEILING_DIRECTORIES": str(self.folder)}

    def refresh(self):
        """Makes the copy equal to the sources, whatever an earlier run left there, and returns what
        identifies their code and their tests. Files that are equal keep their times."""
        command = ["git", "-C", self.root, "ls-files", "-z", "-co", "--exclude-standard"]
        listed = subprocess.run(command, check=True, capture_output=True).stdout.decode()
        names = {name for name in listed.split("\0") if name and (self.root / name).is_file()}
        code, tests = hashlib.sha256(), hashlib.sha256()
        for name in sorted(names):
            content = (self.root / name).read_bytes()
            if name.startswith(CODE) and not name.startswith(NO_CODE):
                code.update(name.encode() + b"\0" + content)
            elif name.startswith(TESTS):
                tests.update(name.encode() + b"\0" + content)
            target = self.source / name
            if not target.is_file() or target.read_bytes() != content:
                target.parent.mkdir(parents=True, exist_ok=True)
                target.write_bytes(content)
                shutil.copymode(self.root / name, target)
        for path in self.source.rglob("*"):
            name = path.relative_to(self.source).as_posix()
            if path.is_file() and name not in names and not name.startswith("build/"):
                path.unlink()
        return code.hexdigest()[:16], tests.hexdigest()[:16]

    def configure(self):
        command = ["cmake", "-S", self.source, "-B", self.build, *OPTIONS]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, env=self.environment)

    def make(self, targets, jobs, timeout):
        """Builds targets; returns the compiler's words if that fails, else an empty text."""
        command = ["cmake", "--build", self.build, "-j", str(jobs), "--target", *targets]
        try:
            done = subprocess.run(
                command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                errors="replace", timeout=timeout, env=self.environment,
            )
        except subprocess.TimeoutExpired:
            return f"not built after {timeout} s"
        return done.stdout if done.returncode else ""

    @contextlib.contextmanager
    def mistake(self, mutant):
        """Puts a mutant into the copy and takes it out again, whatever happens in between. What was
        built of the file is built again with the next mutant, beside it."""
        path = self.source / mutant.file
        before = path.read_text()
        try:
            path.write_text(mutant.applied_to(before))
            yield
        finally:
            path.write_text(before)
