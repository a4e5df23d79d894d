# ./run web and ./run site: the WebAssembly modules and their package, the viewer, the documents as a site.

# pugixml's source, which Debian's package has compiled for its own machines alone. apt gets it with lists of its own.
pugixml_source() {
  local folder=$PWD/build/pugixml apt=$PWD/build/apt options
  [[ -f $folder/src/pugixml.cpp ]] && return 0
  mkdir -p "$folder" "$apt"/{lists,cache/archives}/partial
  # Where packages of this release come from, sources do.
  apt-get indextargets --format 'deb-src $(REPO_URI) $(CODENAME) $(COMPONENT)' 'Created-By: Packages' |
    grep " $(sed -n 's/^VERSION_CODENAME=//p' /etc/os-release) main$" | sort -u >"$apt/sources.list"
  options=(-q -o "Dir::Etc::sourcelist=$apt/sources.list" -o Dir::Etc::sourceparts=/dev/null -o "Dir::State::lists=$apt/lists"
    -o "Dir::Cache=$apt/cache" -o APT::Sandbox::User=root -o Acquire::Retries=5)
  say "the source of pugixml"
  (cd "$apt" && apt-get "${options[@]}" update && apt-get "${options[@]}" source --download-only pugixml) >&2 &&
    tar -xzf "$apt"/pugixml_*.orig.tar.gz -C "$folder" --strip-components 1
}

# The modules of the live objects and of the command line, for engines without and with vector instructions, in the package.
# Either build of a module is started by the same JavaScript. The viewer has a module of its own, with vector instructions.
build_package() {
  local kind package=web/package/dist page=web/viewer/module
  need "${core_packages[@]}" "${web_packages[@]}" || return 1
  command -v node >/dev/null || need nodejs || return 1
  command -v npm >/dev/null || need npm || return 1
  pugixml_source || return 1
  mkdir -p "$package" "$page"
  for kind in wasm wasm-simd; do
    configure "$kind" && build "build/$kind" dymsum_live dymsum_command || return 1
  done
  build build/wasm-simd dymsum_page || return 1
  cp build/wasm-simd/dymsum-page-simd.{js,wasm} "$page"
  cp build/wasm/dymsum{,-command}.{js,wasm} build/wasm-simd/dymsum{,-command}-simd.wasm "$package"
  for kind in dymsum dymsum-command; do
    diff <(sed "s/$kind-simd\.wasm/$kind.wasm/g" "build/wasm-simd/$kind-simd.js") "build/wasm/$kind.js" >&2 || return 1
  done
}

# Counts what node's test runner says of the tests in a folder. check_node FOLDER
check_node() {
  local report=$PWD/build/node.tap good bad
  rm -f "$report"
  (cd "$1" && node --test --test-reporter=tap tests/ >"$report") || true
  good=$(sed -n 's/^# pass //p' "$report") bad=$(sed -n 's/^# fail //p' "$report")
  [[ ${bad:-1} == 0 ]] || sed -n '/^not ok/,/^  \.\.\./p' "$report" >&2
  passed=$((passed + ${good:-0})) failed=$((failed + ${bad:-1}))
}

# The viewer is built on the package, the site with the viewer.
do_web() {
  if need "${core_packages[@]}" "${test_packages[@]}" && configure release && build "$release" dymsum_cli && build_package; then
    check_node web/package
    say "the viewer"
    { viewer_packages && npm run build --prefix web/viewer >&2; } || failed=$((failed + 1))
    do_site || failed=$((failed + 1))
  else
    failed=$((failed + 1))
  fi
  finish
}

# The documents as a site; a link that leads nowhere fails (with mkdocs -q it would not). Commands are shown live where the viewer's file is there.
do_site() {
  local folder=build/site
  need "${core_packages[@]}" "${test_packages[@]}" python3-venv || return 1
  command -v npm >/dev/null || need nodejs npm || return 1  # npm may come with node itself
  { [[ -x $folder/venv/bin/python ]] || python3 -m venv "$folder/venv"; } >&2 || return 1
  "$folder/venv/bin/pip" install -q --retries 10 --disable-pip-version-check --require-hashes -r web/site/requirements.txt >&2 || return 1
  npm ci --prefix web/site --no-audit --no-fund >&2 || return 1
  if [[ -f web/viewer/dist/index.html ]]; then
    configure release && build "$release" dymsum_cli example_demo_shapes example_demo_solids example_first_solid || return 1
    export DYMSUM=$PWD/$release/dymsum
  fi
  NO_MKDOCS_2_WARNING=1 "$folder/venv/bin/mkdocs" build -f web/site/mkdocs.yml >&2 || return 1
  say "the site is $folder/html/index.html"
}
