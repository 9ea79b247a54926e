# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Plants chosen mistakes in a copy of the tree: all in one program, and numbers in its environment say which are made."""

import random
import shutil
import subprocess
from collections import defaultdict

# A mistake that is reached leaves its mark in a file, so that only suites that reach it are run for it.
HEADER = """#pragma once
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>

namespace terracut::mutants {
inline constexpr int kMost = 65536;
inline unsigned char unmarked[kMost];
inline unsigned char* marks_of_file() noexcept {
  const char* path = std::getenv("TERRACUT_MUTANTS_REACHED");
  if (path == nullptr) return unmarked;
  const int file = ::open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0 || ::ftruncate(file, kMost) != 0) return unmarked;
  void* marks = ::mmap(nullptr, kMost, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  ::close(file);
  return marks == MAP_FAILED ? unmarked : static_cast<unsigned char*>(marks);
}
struct Chosen {
  bool numbers[kMost]{};
  Chosen() noexcept {
    const char* listed = std::getenv("TERRACUT_MUTANTS");  // "7,12": several at once
    while (listed != nullptr && *listed != '\\0') {
      char* end = nullptr;
      numbers[std::strtoul(listed, &end, 10) % kMost] = true;
      listed = *end == ',' ? end + 1 : nullptr;
    }
  }
};
inline unsigned char* const marks = marks_of_file();
inline const Chosen chosen;
inline bool reach(int number) noexcept {
  if (marks != nullptr) marks[number] = 1;
  return chosen.numbers[number];
}
constexpr bool planted(int number) noexcept {
  if (__builtin_is_constant_evaluated()) return false;
  return reach(number);
}
}  // namespace terracut::mutants
"""

STRANGE = ("array-bounds", "bool-operation", "conversion", "empty-body", "extra", "float-conversion", "int-in-bool-context",
           "maybe-uninitialized", "misleading-indentation", "parentheses", "return-type", "sign-compare", "stringop-overflow",
           "type-limits", "uninitialized", "unused-but-set-variable", "unused-function", "unused-parameter", "unused-value",
           "unused-variable")  # fmt: skip


def sample(sites, count, seed):
    """Draws sites that do not overlap; the same seed draws the same ones."""
    drawn, taken = [], defaultdict(list)
    order = sorted(sites, key=lambda site: site.key())
    random.Random(seed).shuffle(order)
    for site in order:
        if len(drawn) == count:
            break
        if all(site.end < begin or end < site.begin for begin, end in taken[site.file]):
            taken[site.file].append((site.begin, site.end))
            drawn.append(site)
    return drawn


def copy_tree(repository, tree):
    """Copies what git knows of the working tree, and removes what is gone; files that are the same keep their times."""
    listed = subprocess.run(["git", "-C", repository, "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
                            check=True, capture_output=True, text=True).stdout  # fmt: skip
    names = {name for name in listed.split("\0") if name and (repository / name).exists()}
    for name in names:
        put(tree / name, (repository / name).read_bytes(), repository / name)
    for old in tree.rglob("*"):
        if old.is_file() and "build" not in old.relative_to(tree).parts and str(old.relative_to(tree)) not in names:
            old.unlink()


def put(path, content, mode_of=None):
    if path.is_file() and path.read_bytes() == content:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)
    if mode_of is not None:
        shutil.copymode(mode_of, path)


def sources_of(repository, sites):
    """What the files with these sites are: kept, as whoever edits them goes on while the tree is built."""
    return {name: (repository / name).read_bytes() for name in {site.file for site in sites}}


def plant(sources, tree, numbered):
    """Writes the sources {name: content} with the mistakes {number: site} into the tree."""
    by_file = defaultdict(list)
    for number, site in numbered.items():
        by_file[site.file].append((site.begin, site.end, site.shape.format(id=number)))
    header = tree / "build/planted.hpp"
    put(header, HEADER.encode())
    # Included by those that need it alone: before a precompiled header it would make that useless. What the compiler finds
    # strange about a mistake is no error: tests are to notice it.
    quiet = "".join(f'#pragma GCC diagnostic ignored "-W{name}"\n' for name in STRANGE)
    first = f'#include "{header}"\n{quiet}'.encode()
    for name, places in by_file.items():
        content = sources[name]
        for begin, end, text in sorted(places, reverse=True):
            content = content[:begin] + text.encode() + content[end:]
        put(tree / name, first + content)


def restore(sources, tree, names):
    for name in names:
        put(tree / name, sources[name])
