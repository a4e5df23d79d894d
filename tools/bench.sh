# ./run bench SUITE: opponents that are not Debian's, and the suites.

# A private Python with packages that are not in Debian; without them the benchmark says so. bench_python PACKAGE...
bench_python() {
  local python=build/python
  [[ -z ${DYMSUM_PYTHON:-} ]] || return 0
  need python3-venv || return 0
  { { [[ -x $python/bin/python ]] || python3 -m venv "$python"; } && "$python/bin/pip" install -q "$@" numpy; } >&2 ||
    { say "no $*"; return 0; }
  export DYMSUM_PYTHON=$PWD/$python/bin/python
}

# Clipper2's sources, which Debian 12 has not: the Python package pyclipr carries them. Left out where they cannot be had.
clipper2_sources() {
  local folder=$PWD/build/clipper2 python=build/python
  if [[ ! -d $folder/CPP ]]; then
    need python3-venv || return 0
    { [[ -x $python/bin/python ]] || python3 -m venv "$python"; } >&2 &&
      "$python/bin/pip" download -q --no-deps --no-binary pyclipr -d "$folder" pyclipr==0.1.8 >&2 &&
      tar -xzf "$folder"/pyclipr-0.1.8.tar.gz -C "$folder" --strip-components 3 pyclipr-0.1.8/external/clipper2/CPP ||
      { say "no Clipper2"; return 0; }
  fi
  cmake -DDYMSUM_CLIPPER2="$folder/CPP/Clipper2Lib" "$release" >&2
}

# The command line of an earlier COMMIT, built in build/base/COMMIT; prints its path. base_program COMMIT
base_program() {
  local folder=$PWD/build/base/$1
  [[ -d $folder ]] || git worktree add -f --detach "$folder" "$1" >&2 || return
  (cd "$folder" && cmake --preset release >&2 && cmake --build build/release -j "$(jobs)" --target dymsum_cli >&2) || return
  echo "$folder/build/release/dymsum"
}

# What a change costs: bench_pairs --base COMMIT ARGS...
bench_pairs() {
  [[ ${1:-} == --base && -n ${2:-} ]] || { say "pairs needs --base COMMIT, the state to compare with"; return 1; }
  build "$release" dymsum_cli
  local program
  program=${DYMSUM_BASE:-$(base_program "$(git rev-parse --short "$2")")} || return
  DYMSUM=$PWD/$release/dymsum DYMSUM_BASE=$program python3 bench/pairs/pairs.py "$@"
}

do_bench() {
  local suite=${1:-planar}
  (($# == 0)) || shift
  [[ -d bench ]] || { say "there is no bench folder"; return 1; }
  need "${core_packages[@]}" "${test_packages[@]}" "${bench_packages[@]}"
  configure bench
  if [[ $suite == off-the-grid ]]; then
    for suite in planar scaling cspace growing nesting solid moving-solids convex depth python; do
      do_bench "$suite" --off-grid "$@" || return
    done
    return
  fi
  if [[ $suite == pairs ]]; then
    bench_pairs "$@"
    return
  fi
  if [[ $suite == coordinates ]]; then
    build "$release" dymsum_cli
    DYMSUM=$PWD/$release/dymsum python3 bench/coordinates/coordinates.py "$@"
    return
  fi
  if [[ $suite == files ]]; then
    build "$release" dymsum_cli
    bench_python manifold3d numpy
    DYMSUM=$PWD/$release/dymsum "${DYMSUM_PYTHON:?}" bench/files/files.py "$@"
    return
  fi
  if [[ $suite == boolean ]]; then
    build "$release" dymsum_cli
    bench_python shapely pyclipr numpy manifold3d
    local rival=build/cgal_boolean
    if need libcgal-dev && g++ -O3 -DNDEBUG -std=c++17 bench/versus/cgal_boolean.cpp -o "$rival" -lmpfr -lgmp; then
      export CGAL_BOOLEAN=$PWD/$rival
    else
      say "without CGAL"
    fi
    rival=build/cgal_regions
    if need libcgal-dev && g++ -O3 -DNDEBUG -std=c++17 bench/versus/cgal_regions.cpp -o "$rival" -lmpfr -lgmp; then
      export CGAL_REGIONS=$PWD/$rival
    else
      say "without CGAL's regions"
    fi
    DYMSUM=$PWD/$release/dymsum "${DYMSUM_PYTHON:?}" bench/boolean/boolean.py "$@"
    return
  fi
  if [[ $suite == gallery ]]; then
    build "$release" dymsum_cli
    bench_python shapely pyclipper manifold3d python-fcl
    DYMSUM=$PWD/$release/dymsum "${DYMSUM_PYTHON:?}" bench/gallery/gallery.py "$@"
    return
  fi
  if [[ $suite == python || $suite == clusters ]]; then
    local program=overhead
    [[ $suite == python ]] || program=scaling_out
    build "$release" dymsum && python_environment && install_python
    [[ $suite == clusters ]] || build/python/venv/bin/pip install -q pyclipper >&2 || say "no pyclipper"
    build/python/venv/bin/python "bench/python/$program.py" "$@"
    return
  fi
  case $suite in
    planar) clipper2_sources ;;
    convex | depth) bench_python coal ;;
    solid) bench_python manifold3d ;;
  esac
  build "$release" "dymsum_bench_${suite//-/_}"
  "$release/bench/dymsum_bench_${suite//-/_}" "$@"
}
