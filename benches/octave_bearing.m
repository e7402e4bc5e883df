% The same right-hand side in Octave, vectorised over contacts and slices, and ode45 on it.
%
%   octave_bearing(input, output)
%
% Reads tables, states to check, start, times and settings from one MAT file, as benches/peers.py writes it;
% writes the derivatives of the states, and of every setting the processor's time [s] and the outer ring's
% accelerations at the times (3 x times).
function octave_bearing(input, output)
  b = load(input);
  f = @(t, y) rhs(y, b);
  derivatives = zeros(size(b.states));
  for i = 1:rows(b.states)
    derivatives(i, :) = f(0, b.states(i, :)')';
  end
  count = numel(b.tolerance);
  seconds = zeros(1, count);
  accelerations = zeros(3, numel(b.times), count);
  for k = 1:count
    % As in Python: the tolerance is absolute, by kind of state.
    settings = odeset('RelTol', b.rtol, 'AbsTol', b.tolerance(k) * b.scale(:), 'MaxStep', b.max_step(k));
    begun = cputime();
    [~, y] = ode45(f, b.times, b.start(:), settings);
    seconds(k) = cputime() - begun;
    for i = 1:numel(b.times)
      accelerations(:, i, k) = f(0, y(i, :)')(end / 2 + (1:3));
    end
  end
  save('-v7', output, 'derivatives', 'seconds', 'accelerations');
end

function dy = rhs(y, b)
  half = numel(y) / 2;
  q = reshape(y(1:half), 4, [])';
  v = reshape(y(half+1:end), 4, [])';
  bodies = rows(q);
  force = b.constant - b.spring .* (q - b.place) - b.damper .* v + cage(q, v, b);

  % Contacts that touch: ball and groove are two circles in the meridional plane.
  dx = q(b.ball, 1) - q(b.ring, 1);
  dy_ = q(b.ball, 2) - q(b.ring, 2);
  d = hypot(dx, dy_);
  dz = q(b.ball, 3) - q(b.ring, 3);
  on = find(hypot(d - b.groove_a, dz - b.groove_z) + b.radius > b.groove_r);
  n = [dx, dy_](on, :) ./ d(on);
  d = d(on);
  dz = dz(on);
  sigma = b.sigma(on);

  % Penetration of all slices, contacts x slices; then a list of those that touch.
  z = dz + b.zeta;
  radius = b.groove_a(on) + sigma .* sqrt(max(b.groove_r(on) .^ 2 - (z - b.groove_z(on)) .^ 2, 0));
  s = sigma .* (d - radius) + b.rho;
  at = find(s > 0);
  [c, k] = ind2sub(size(s), at);
  s = s(at);
  radius = radius(at);
  n = n(c, :);
  ball = b.ball(on)(c);
  ring = b.ring(on)(c);
  E = law(s, b);
  n_e = sigma(c) .* n;
  p = q(ring, 1:2) + radius .* n;

  % Slices inside the defect: two edge circles, and the race at s12 (narrow rule).
  defect = b.defect(on, :)(c, :);
  beta = defect(:, 4) ./ (2 * radius);
  phi = defect(:, 1) + q(ring, 4);
  away = abs(atan2(n(:, 2) .* cos(phi) - n(:, 1) .* sin(phi), n(:, 1) .* cos(phi) + n(:, 2) .* sin(phi)));
  h = find(abs(z(at) - defect(:, 2)) <= defect(:, 3) & away <= beta);
  if ! isempty(h)
    [s_1, n_1, p_1] = edge(h, -1);
    [s_2, n_2, p_2] = edge(h, 1);
    E(h) = law(max(s_1 + s_2 - s(h), 0), b);
    E = [E; law(max(s_1, 0), b) - E(h); law(max(s_2, 0), b) - E(h)];
    n_e = [n_e; n_1; n_2];
    p = [p; p_1; p_2];
    ball = [ball; ball(h); ball(h)];
    ring = [ring; ring(h); ring(h)];
    k = [k; k(h); k(h)];
  end

  % Damping and friction of every element of the list.
  [tan_, sin_, cos_] = deal(b.tan(k)', b.sin(k)', b.cos(k)');
  arm = p - q(ball, 1:2);
  lever = p - q(ring, 1:2);
  w = v(ball, 1:2) + v(ball, 4) .* [-arm(:, 2), arm(:, 1)] ...
      - v(ring, 1:2) - v(ring, 4) .* [-lever(:, 2), lever(:, 1)];
  wz = v(ball, 3) - v(ring, 3);
  approach = sum(w .* n_e, 2);
  F = max(E, 0) .* max(1 + 1.5 * b.damping * (approach + wz .* tan_), 0);
  u_t = w(:, 2) .* n_e(:, 1) - w(:, 1) .* n_e(:, 2);
  u_m = wz .* cos_ - approach .* sin_;
  rub = b.friction * F ./ sqrt(u_t .^ 2 + u_m .^ 2 + b.slip_speed ^ 2);
  f = (rub .* u_m .* sin_ - F) .* n_e - rub .* u_t .* [-n_e(:, 2), n_e(:, 1)];
  fz = -F .* tan_ - rub .* u_m .* cos_;
  on_ball = [f, fz, arm(:, 1) .* f(:, 2) - arm(:, 2) .* f(:, 1)];
  on_ring = -[f, fz, lever(:, 1) .* f(:, 2) - lever(:, 2) .* f(:, 1)];
  for i = 1:4
    force(:, i) += accumarray([ball; ring], [on_ball(:, i); on_ring(:, i)], [bodies, 1]);
  end
  dy = [y(half+1:end); (force .* b.mobility)'(:)];

  function [s_j, n_j, p_j] = edge(h, side)
    angle = phi(h) + side * beta(h);
    r_f = defect(h, 5);
    centre = q(ring(h), 1:2) + (radius(h) + r_f) .* [cos(angle), sin(angle)];
    line = centre - q(ball(h), 1:2);
    far = hypot(line(:, 1), line(:, 2));
    s_j = b.rho(k(h))' + r_f - far;
    n_j = line ./ far;
    p_j = centre - r_f .* n_j;
  end
end

% Elastic force of slices.
function F = law(s, b)
  F = b.stiffness * s .^ (10 / 9);
end

% Links between neighbouring balls.
function force = cage(q, v, b)
  line = q(b.next, 1:2) - q(b.this, 1:2);
  far = hypot(line(:, 1), line(:, 2));
  line ./= far;
  rate = sum((v(b.next, 1:2) - v(b.this, 1:2)) .* line, 2);
  pull = (b.cage_stiffness * (far - b.cage_distance) + b.cage_damping * rate) .* line;
  force = zeros(size(q));
  force(b.this, 1:2) += pull;
  force(b.next, 1:2) -= pull;
end
