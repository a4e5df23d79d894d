# ./run demo: sums of real polygons and of solids, as pictures.

do_demo() {
  need "${core_packages[@]}" "${test_packages[@]}" || return
  configure release
  build "$release" example_demo_shapes
  mkdir -p demo
  local dymsum=$release/dymsum data=../shared/data/planar turn=demo/turn.glb
  [[ ! -f web/viewer/dist/index.html ]] || turn=demo/turn.html  # the viewer, where `./run web` has built it
  "$release/examples/demo_shapes" demo/shapes
  say "the first picture: demo/shapes/plate_and_star.svg"
  build "$release" dymsum_cli example_demo_solids

  draw() {  # draw NAME VERB P Q: the sum and its stages as pictures, its numbers on the screen
    local name=$1
    shift
    say "$name"
    "$dymsum" "$@" -o "demo/$name.svg" -o "demo/$name.stages.svg" -o "demo/$name.json"
    rsvg-convert -w 1600 "demo/$name.svg" -o "demo/$name.png"
  }
  draw plate_and_star sum demo/shapes/plate.wkt demo/shapes/star.wkt
  draw gear_and_star sum demo/shapes/gear.wkt demo/shapes/star.wkt
  draw grate_and_disc sum demo/shapes/grate.wkt demo/shapes/disc.wkt
  draw peg_in_its_slot nfp demo/shapes/slot.wkt demo/shapes/peg.wkt
  draw inner_fit erode demo/shapes/slot.wkt demo/shapes/peg.wkt
  if [[ -d $data ]]; then
    draw monkey_and_bird sum "$data/monkey.poly" "$data/bird.poly" --repair
    draw neuron_and_disc sum "$data/neuron.poly" demo/shapes/disc32.wkt --repair
    draw dog_and_star sum "$data/dog.poly" "$data/star.poly" --repair
  else
    draw spiral_and_star sum demo/shapes/spiral.wkt demo/shapes/star.wkt
    draw random_and_gear sum demo/shapes/random.wkt demo/shapes/gear.wkt
  fi
  say "convex solids: a sum, and a turn"
  mkdir -p demo/solids
  "$release/examples/demo_solids" demo/solids
  "$dymsum" sum demo/solids/ellipse.off demo/solids/T.off -o demo/ellipse_and_T.glb
  "$dymsum" rotate demo/solids/v-rod.off demo/solids/cube.off --steps 120 --axis 1,2,3 -o "$turn"
  "$dymsum" depth demo/solids/TI.off demo/solids/cube.off --move 0.5,0,0
  say "compared with CGAL"
  need "${bench_packages[@]}" && configure bench && build "$release" dymsum_bench_planar || return
  "$release/bench/dymsum_bench_planar" --demo
  say "pictures are in demo/"
}
