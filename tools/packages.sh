# Packages, configured and built folders: what every verb of ../run begins with.

readonly release=build/release debug=build/debug thread=build/thread program_parts=12
readonly core_packages=(g++ cmake ninja-build libboost-dev nlohmann-json3-dev libpugixml-dev libcli11-dev libtbb-dev
                       libcpp-httplib-dev libzip-dev zlib1g-dev libsqlite3-dev pkg-config)
readonly test_packages=(libgtest-dev libgmp-dev libmpfr-dev librsvg2-bin clang-14 libompl-dev)
readonly verify_packages=(libcgal-dev clang-15 clang-16)
readonly web_packages=(emscripten libfmt-dev libfast-float-dev xz-utils)
readonly format_packages=(clang-format-14)  # one version: others break lines elsewhere
readonly bench_packages=(libcgal-dev libpolyclipping-dev libbenchmark-dev libfcl-dev libccd-dev libbullet-dev libeigen3-dev)

say() { printf '== %s\n' "$*" >&2; }

# Parallel jobs: one per core, but 2 GB of memory for each, for the largest template instantiations.
jobs() {
  local cores memory
  cores=$(nproc)
  memory=$(awk '/^MemAvailable/ {print int($2 / 2000000)}' /proc/meminfo)
  echo "${JOBS:-$((memory < 1 ? 1 : memory < cores ? memory : cores))}"
}

as_root() {
  if [[ $(id -u) == 0 ]]; then "$@"; else sudo "$@"; fi
}

# Installs those of the named Debian packages that are missing; apt is retried because mirrors fail now and then.
need() {
  local package missing=() attempt
  command -v dpkg-query >/dev/null || { say "not a Debian system; expecting to find: $*"; return 0; }
  for package in "$@"; do
    [[ $(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null) == installed ]] || missing+=("$package")
  done
  [[ ${#missing[@]} == 0 ]] && return 0
  if [[ $(id -u) != 0 ]] && ! command -v sudo >/dev/null; then
    say "missing packages; as root: apt-get install ${missing[*]}"
    return 1
  fi
  say "installing ${missing[*]}"
  for attempt in 1 2 3; do
    if as_root apt-get update -q >&2 &&
       as_root env DEBIAN_FRONTEND=noninteractive \
         apt-get install -y -q --no-install-recommends "${missing[@]}" >&2; then
      return 0
    fi
    say "apt-get failed (attempt $attempt of 3)"
    sleep $((attempt * 5))
  done
  return 1
}

# configure PRESET, build DIR TARGET...
configure() { cmake --preset "$1" >&2; }
build() {
  local folder=$1
  shift
  cmake --build "$folder" -j "$(jobs)" --target "$@" >&2
}

# Every C++ source but those of the layering test's fixture, which is never compiled.
sources() { find include src cli adapters tests bench examples python/src web/wasm -name '*.h' -o -name '*.cpp' | grep -v '^tests/layering/fixture/' | sort; }

do_format() {
  need "${format_packages[@]}"
  if [[ ${1:-} == --check ]]; then
    sources | xargs clang-format-14 --dry-run -Werror
  else
    sources | xargs clang-format-14 -i
  fi
}
