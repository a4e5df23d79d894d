# ./run test and ./run verify: what is tested, and how many tests passed and failed.

passed=0 failed=0
# Adds what a report of ctest or pytest says to the totals; a run without a report is a failure.
count() {
  local head total bad skipped disabled errors
  head=$(tr '\n\t' '  ' <"$1" 2>/dev/null | grep -o '<testsuite [^>]*>' | head -n 1 || true)
  number() { sed -n "s/.* $1=\"\([0-9]*\)\".*/\1/p" <<<"$head"; }
  total=$(number tests) bad=$(number failures) skipped=$(number skipped) disabled=$(number disabled) errors=$(number errors)
  if [[ -z $total || $total == 0 ]]; then
    say "no tests ran: $1"
    failed=$((failed + 1))
    return
  fi
  skipped=$((skipped + ${disabled:-0})) bad=$((bad + ${errors:-0}))
  ((skipped == 0)) || say "$skipped tests skipped"
  passed=$((passed + total - bad - skipped))
  failed=$((failed + bad))
}

# Runs the tests of a build folder that ARGS of ctest select, each in a process of its own. one_by_one FOLDER ARGS...
one_by_one() {
  local folder=$1 report=$PWD/$1/report.xml
  shift
  rm -f "$report"
  [[ -z ${DYMSUM_TEST_FILTER:-} ]] || set -- "$@" -R "$DYMSUM_TEST_FILTER"
  ctest --test-dir "$folder" -j "$(jobs)" --output-on-failure --output-junit "$report" --progress "$@" >&2 || true
  count "$report"
}

# Builds TARGETs of a build folder, as much of them as compiles. build_most FOLDER "TARGET..."
build_most() {
  # shellcheck disable=SC2086
  cmake --build "$1" -j "$(jobs)" --target $2 -- -k 0 >&2 && return
  say "the build of $1 failed"
  failed=$((failed + 1))
}

# Builds TARGETs of a build folder and runs its tests, each in a process of its own. check FOLDER "TARGET..." ARGS...
check() {
  build_most "$1" "$2"
  one_by_one "$1" "${@:3}"
}

# Every so many tests of a program: to start a process takes longer than most of them. program_part PROGRAM PART
program_part() {
  local report=$release/parts/$1.$2
  GTEST_TOTAL_SHARDS=$program_parts GTEST_SHARD_INDEX=$2 GTEST_OUTPUT=xml:$PWD/$report.xml ASAN_OPTIONS=malloc_context_size=2 \
    timeout 1200 "$release/tests/$1" >"$report.log" 2>&1 && touch "$report.passed"
}

# The tests of these programs by parts. Where not every test that a program lists has run and passed or asked to be skipped,
# the program's are run one by one, and those results count. check_programs "PROGRAM..."
check_programs() {
  local program part listed run skipped
  say "all tests of $*"
  rm -rf "$release/parts"
  mkdir -p "$release/parts"
  for program in $1; do
    for ((part = 0; part < program_parts; ++part)); do echo "$program $part"; done
  done | xargs -n 2 -P "$(jobs)" bash -c 'program_part "$@" || true' part
  for program in $1; do
    listed=$("$release/tests/$program" --gtest_list_tests 2>/dev/null | grep -c '^  ' || true)
    run=$(cat "$release/parts/$program".*.xml 2>/dev/null | grep -c '<testcase .*status="run"' || true)
    skipped=$(cat "$release/parts/$program".*.xml 2>/dev/null | grep -c '<testcase .*result="skipped"' || true)
    part=$(find "$release/parts" -name "$program.*.passed" | wc -l)
    if [[ $listed -gt 0 && $run == "$listed" && $part == "$program_parts" ]]; then
      passed=$((passed + run - skipped))
      ((skipped == 0)) || say "$skipped tests of $program skipped"
    else
      say "$program: $run of $listed tests run, $part of $program_parts parts passed; one by one"
      program_one_by_one "$program"
    fi
  done
}

# program_one_by_one PROGRAM: tests_ROOM or tests_ROOM_sanitized
program_one_by_one() {
  local room=${1#tests_}
  if [[ $room == *_sanitized ]]; then DYMSUM_SANITIZE_ROOMS=${room%_sanitized} one_by_one "$release" -L sanitized
  else one_by_one "$release" -L "^$room\$"; fi
}

# Does what a function checks beside what follows, up to `joined`, which adds its counts. beside FUNCTION
beside() {
  mkdir -p build
  rm -f build/beside
  (passed=0 failed=0; "$1"; echo "$passed $failed" >build/beside) &
}
joined() {
  local good=0 bad=1
  wait || true
  [[ ! -s build/beside ]] || read -r good bad <build/beside
  passed=$((passed + good)) failed=$((failed + bad))
}

# Counts whether another compiler takes these files as they are. read_with COMPILER FILE...
read_with() {
  local compiler=$1
  shift
  say "$compiler reads $# files"
  if printf '%s\n' "$@" | xargs -P "$(jobs)" -n 8 "$compiler" -std=c++20 -fsyntax-only -Iinclude -Isrc -Icli >&2; then
    passed=$((passed + 1))
  else
    failed=$((failed + 1))
  fi
}

# The private environment of the Python package; pip is patient, because mirrors fail now and then.
python_environment() {
  local folder=build/python/venv
  need python3-venv python3-dev || return 1
  { [[ -x $folder/bin/python ]] || python3 -m venv "$folder"; } >&2 &&
    "$folder/bin/pip" install -q --retries 10 --disable-pip-version-check -r python/requirements.txt >&2
}

# The package, on the library that is built already: install_python
install_python() {
  build/python/venv/bin/pip install -q --disable-pip-version-check --no-build-isolation --no-deps --force-reinstall \
    --config-settings=build-dir=build/python/wheel --config-settings=cmake.define.DYMSUM_LIBRARY="$PWD/$release/libdymsum.a" . >&2
}

# Builds the Python package and runs its tests; ARGS of pytest select some. check_python ARGS...
check_python() {
  local report=$PWD/build/python/report.xml
  rm -f "$report"
  python_environment && cmake --build "$release" -j "$(jobs)" --target dymsum >&2 && install_python &&
    build/python/venv/bin/python -m pytest -q --junitxml="$report" "$@" >&2 || true
  count "$report"
}

# The packages of the viewer; npm is patient, because mirrors fail now and then.
viewer_packages() {
  { command -v npm >/dev/null || need nodejs npm; } &&
    (cd web/viewer && npm ci --no-audit --no-fund --fetch-retries 10) >&2
}

# Counts what vitest says of the viewer's tests. check_vitest ARGS...
check_vitest() {
  local report=$PWD/build/viewer.json good bad
  mkdir -p build
  rm -f "$report"
  (cd web/viewer && npx vitest run --reporter=default --reporter=json --outputFile.json="$report" "$@") >&2 || true
  good=$(node -p "require('$report').numPassedTests" 2>/dev/null) || good=0
  bad=$(node -p "require('$report').numFailedTests" 2>/dev/null) || bad=1
  [[ $good != 0 ]] || bad=$((bad + 1))
  passed=$((passed + good)) failed=$((failed + bad))
}

# Lint, types and unit tests of the viewer.
check_viewer() {
  local step
  say "the viewer: lint, types, unit tests"
  viewer_packages || { failed=$((failed + 1)); return; }
  for step in lint check; do
    if npm run -s "$step" --prefix web/viewer >&2; then passed=$((passed + 1)); else failed=$((failed + 1)); fi
  done
  check_vitest
}

# The programs of the rooms' tests, as CTest has them.
room_programs() { find tests -mindepth 2 -name '*_test.cpp' | cut -d / -f 2 | sort -u | grep -v -x -e cgal -e ompl -e fuzz | sed 's/^/tests_/' | tr '\n' ' '; }

finish() {
  echo "$passed passed, $failed failed"
  ((failed == 0))
}

do_test() {
  need "${core_packages[@]}" "${test_packages[@]}" || { failed=1; finish; return; }
  say "layout of the sources"
  if do_format --check; then passed=$((passed + 1)); else failed=$((failed + 1)); fi
  # shellcheck disable=SC2046
  read_with clang++-14 $(find examples -name "*.cpp" ! -name "ompl_*") src/base/*.cpp src/planar/mask/*.cpp
  configure release || { failed=$((failed + 1)); finish; return; }
  local rooms=${DYMSUM_SANITIZE_ROOMS-base io}  # what reads strangers' bytes; the others in `./run verify`
  unset DYMSUM_SANITIZE_ROOMS  # CTest lists the sanitized tests of the rooms in it
  # shellcheck disable=SC2086
  local sanitized=${rooms:+$(printf 'tests_%s_sanitized ' $rooms)}
  build_most "$release" "all tests $sanitized"
  if [[ -n ${DYMSUM_TEST_FILTER:-} ]]; then
    one_by_one "$release"
    [[ -z $rooms ]] || DYMSUM_SANITIZE_ROOMS=$rooms one_by_one "$release" -L sanitized
  else
    check_programs "$(room_programs) $sanitized"
    one_by_one "$release" -L 'fuzz|package'  # what is no program of GoogleTest
    beside check_viewer
    say "the Python package"
    check_python
    joined
  fi
  finish
}

do_verify() {
  unset DYMSUM_SANITIZE_ROOMS  # all of them, whole
  need "${core_packages[@]}" "${test_packages[@]}" "${verify_packages[@]}" || { failed=1; finish; return; }
  export DYMSUM_FUZZ_PAIRS=${DYMSUM_FUZZ_PAIRS:-200000} DYMSUM_FUZZ_MOVES=${DYMSUM_FUZZ_MOVES:-100000}
  export DYMSUM_FUZZ_OBSTACLES=${DYMSUM_FUZZ_OBSTACLES:-20} DYMSUM_FUZZ_SIGNS=${DYMSUM_FUZZ_SIGNS:-1000000}
  export DYMSUM_FUZZ_ROTATIONS=${DYMSUM_FUZZ_ROTATIONS:-20} DYMSUM_FUZZ_FACES=${DYMSUM_FUZZ_FACES:-1100}
  configure release && cmake -DDYMSUM_TEST_TIMEOUT=7200 -DDYMSUM_TEST_OMPL=ON -DDYMSUM_TEST_CGAL=ON "$release" >/dev/null ||
    { failed=1; finish; return; }
  local version
  for version in 14 15 16; do
    # shellcheck disable=SC2046
    read_with "clang++-$version" $(find src cli -name '*.cpp')
  done
  say "all tests, with $DYMSUM_FUZZ_PAIRS fuzz pairs"
  check "$release" "all tests"
  unset DYMSUM_FUZZ_PAIRS DYMSUM_FUZZ_MOVES DYMSUM_FUZZ_OBSTACLES DYMSUM_FUZZ_SIGNS DYMSUM_FUZZ_ROTATIONS DYMSUM_FUZZ_FACES
  say "the WebAssembly package, and the viewer in Chromium and Firefox"
  if need chromium firefox-esr && build_package && viewer_packages && npm run build --prefix web/viewer >&2; then
    check_node web/package
    check_vitest --config e2e.config.ts
  else
    failed=$((failed + 1))
  fi
  say "the site of the documents: its links, and the search in Chromium"
  if do_site && need chromium && npm test --prefix web/site >&2; then passed=$((passed + 1)); else failed=$((failed + 1)); fi
  say "the Python package on clusters"
  python_environment && build/python/venv/bin/pip install -q --retries 10 --disable-pip-version-check -r python/requirements-verify.txt >&2 || true
  check_python -m cluster
  say "all tests under address and undefined-behaviour sanitizers"
  configure debug && cmake -DDYMSUM_TEST_TIMEOUT=3600 -DDYMSUM_SANITIZE_MEMBERS=ON "$debug" >/dev/null || { failed=$((failed + 1)); finish; return; }
  check "$debug" "all tests"
  say "windows that are made ahead on a thread of their own, under the thread sanitizer"
  configure thread && DYMSUM_TEST_FILTER="ScalingWindows|RotatingWindows|MovingSum" check "$thread" tests_planar || failed=$((failed + 1))
  finish
}

export release program_parts
export -f program_part
