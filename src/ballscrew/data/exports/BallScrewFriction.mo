within;
package BallScrewFriction "A ball screw with its friction, as ballscrew computed it"
@NOTES@

  function frictionTorque "Size of the friction on the shaft, N m, and whether the model holds there"
    input Real load "Axial load on the nut, N: positive where a positive speed lifts it";
    input Real speed "Speed of the screw, rad/s";
    output Real torque "Friction torque, N m";
    output Real valid "1 where the model holds and load and speed are in their range, else 0";
  protected
    constant Integer n = @LOADS@;
    constant Integer m = @SPEEDS@;
    constant Real F[n] = @F@;
    constant Real W[m] = @W@;
    constant Real M[n, m] = @M@;
    constant Real V[n, m] = @V@;
    Real f;
    Real w;
    Real a;
    Real b;
    Integer i;
    Integer j;
  algorithm
    f := min(max(load, F[1]), F[n]);
    w := min(max(speed, W[1]), W[m]);
    i := 1;
    while i < n - 1 and f > F[i + 1] loop
      i := i + 1;
    end while;
    j := 1;
    while j < m - 1 and w > W[j + 1] loop
      j := j + 1;
    end while;
    a := (f - F[i])/(F[i + 1] - F[i]);
    b := (w - W[j])/(W[j + 1] - W[j]);
    torque := (1 - a)*((1 - b)*M[i, j] + b*M[i, j + 1]) + a*((1 - b)*M[i + 1, j] + b*M[i + 1, j + 1]);
    valid := if load < F[1] or load > F[n] or speed < W[1] or speed > W[m] then 0.0
      else min(min(V[i, j], V[i, j + 1]), min(V[i + 1, j], V[i + 1, j + 1]));
  end frictionTorque;

  model BallScrew "Turns the rotation of flange_a into the travel of flange_b, with friction"
    Modelica.Mechanics.Rotational.Interfaces.Flange_a flange_a "Shaft";
    Modelica.Mechanics.Translational.Interfaces.Flange_b flange_b "Nut";
    constant Real torqueOfLoad(unit = "m/rad") = @IDEAL@ "Torque without friction over axial load";
    constant Real travel(unit = "m/rad") = @TRAVEL@ "Travel over rotation: the lead over 2 pi";
    parameter Real speedAtRest(unit = "rad/s", min = 0) = @AT_REST@ "Below it friction is a slope through zero";
    Real w(unit = "rad/s") "Speed of the screw";
    Real axialLoad(unit = "N") "Load on the nut";
    Real screwTorque(unit = "N.m") "Size of the friction on the shaft";
    Real valid "1 where the model holds, else 0";
  equation
    flange_b.s = travel*flange_a.phi;
    w = der(flange_a.phi);
    axialLoad = -flange_b.f;
    (screwTorque, valid) = BallScrewFriction.frictionTorque(axialLoad, w);
    flange_a.tau = torqueOfLoad*axialLoad + screwTorque*tanh(w/speedAtRest);
  end BallScrew;

  model Example "A motor lifts @MASS@ kg, lets it sink, and lifts it again"
    BallScrew screw;
    Modelica.Mechanics.Rotational.Components.Inertia rotor(
      J = @ROTOR@, phi(fixed = true, start = 0), w(fixed = true, start = 0));
    Modelica.Mechanics.Translational.Components.Mass mass(m = @MASS@);
    Modelica.Mechanics.Translational.Sources.ConstantForce weight(f_constant = -9.81*@MASS@);
    Modelica.Mechanics.Rotational.Sources.Torque motor;
    Modelica.Blocks.Sources.Sine torque(amplitude = @AMPLITUDE@, f = 1, offset = @OFFSET@);
  equation
    connect(torque.y, motor.tau);
    connect(motor.flange, rotor.flange_a);
    connect(rotor.flange_b, screw.flange_a);
    connect(screw.flange_b, mass.flange_a);
    connect(weight.flange, mass.flange_b);
  end Example;
  annotation(uses(Modelica(version = "4.0.0")));
end BallScrewFriction;
