# Shared by tools/setup, tools/demo and tools/test; source it, do not run it.
# shellcheck shell=bash

repo=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
export repo

# ccache knows a file again in every checkout of the project, wherever that lies.
# It takes precompiled headers as they come.
export CCACHE_BASEDIR=$repo CCACHE_NOHASHDIR=yes CCACHE_SLOPPINESS=pch_defines,time_macros

say() { printf '\n== %s\n' "$*" >&2; }
die() {
  printf 'error: %s\n' "$*" >&2
  exit 1
}

# How many compilers may run at once: one a core, but no more than memory allows (1 GiB each).
build_jobs() {
  local cores memory_kib by_memory
  cores=$(nproc)
  memory_kib=$(awk '/MemAvailable/ {print $2}' /proc/meminfo)
  by_memory=$((memory_kib / 1048576))
  [ "$by_memory" -ge 1 ] || by_memory=1
  echo $((cores < by_memory ? cores : by_memory))
}

# The compiler to build with: $CXX if set, else the distribution's g++ where it is 12 or newer, else g++-12.
choose_cxx() {
  if [ -n "${CXX:-}" ]; then
    echo "$CXX"
  elif command -v g++ >/dev/null && [ "$(g++ -dumpversion | cut -d. -f1)" -ge 12 ]; then
    echo g++
  else
    echo g++-12
  fi
}

# The newest clang++ that has RealtimeSanitizer with its runtime, which clang 20 is the first to have;
# nothing where there is none.
realtime_clang() {
  local compiler
  while read -r compiler; do
    if echo 'int main() {}' | "$compiler" -fsanitize=realtime -x c++ - -o /dev/null 2>/dev/null; then
      echo "$compiler"
      return
    fi
  done < <(compgen -c clang++- | grep -E '^clang\+\+-[0-9]+$' | sort -t- -k2 -rnu)
}

# Configures (only the first time: CMake notices later changes itself) and builds.
# configure_and_build PRESET TARGET [cmake options...]
configure_and_build() {
  local preset=$1 target=$2
  shift 2
  local folder=$repo/build/$preset launcher=()
  if command -v ccache >/dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
  if [ ! -f "$folder/build.ninja" ]; then
    say "Configuring build/$preset"
    (cd "$repo" && cmake --preset "$preset" "${launcher[@]}" "$@") ||
      die "CMake could not configure build/$preset; the reason stands above (missing packages: ./tools/setup)"
  fi
  say "Building build/$preset ($(build_jobs) at a time)"
  cmake --build "$folder" --parallel "$(build_jobs)" --target "$target" ||
    die "the build of build/$preset failed; the first error stands above"
}
