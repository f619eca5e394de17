# Writes examples/chain_200.yaml:  awk -f examples/chain_200.awk > examples/chain_200.yaml
# A hanging chain of n links, each a slender rod, that starts at rest along a straight line and swings.
BEGIN {
  n = 200
  length_ = 0.05  # of a link [m]
  mass = 0.04     # [kg]
  printf "# A chain of %d links of %g mm, at rest along a straight line 20 degrees from the vertical; it swings under its weight.\n", n, 1000 * length_
  printf "# Written by examples/chain_200.awk:  awk -f examples/chain_200.awk > examples/chain_200.yaml\n"
  printf "#   pintle run examples/chain_200.yaml\n"
  printf "title: Chain of %d links\n", n
  printf "gravity: [0, -9.81]\n"
  printf "parameters: {mass: %g kg, inertia: %.10g kg*m^2, half: %g m}\n", mass, mass * length_ * length_ / 12, length_ / 2
  printf "bodies:\n"
  angle = -70 * atan2(0, -1) / 180
  for (i = 1; i <= n; i++) {
    at = (i - 0.5) * length_
    printf "  L%d: {rigid: {mass: mass, inertia: inertia}, points: {A: [-half, 0], B: [half, 0]}, pose: {at: [%.6f, %.6f], angle: -70 deg}}\n", i, at * cos(angle), at * sin(angle)
  }
  printf "joints:\n"
  printf "  J1: {revolute: [ground, L1.A]}\n"
  for (i = 2; i <= n; i++) printf "  J%d: {revolute: [L%d.B, L%d.A]}\n", i, i - 1, i
  printf "start:\n"
  for (i = 1; i <= n; i++) printf "  L%d: {angle: -70 deg, speed: 0}\n", i
  printf "run: {until: 1 s}\n"
  printf "output: {every: 10 ms, points: [L%d.B]}\n", n
}
