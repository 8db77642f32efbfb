within ContactMultiBodyTest.Agreement;
model BodiesOfTwoForms "A tumbling body moves alike with and without the constraint of its quaternion"
  extends Modelica.Icons.Example;
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1});
  ContactMultiBody.Parts.Body constrained(
    m=2,
    r_CM={0.1,-0.05,0.02},
    I_11=0.02,
    I_22=0.05,
    I_33=0.04,
    I_21=0.003,
    I_31=-0.002,
    I_32=0.004,
    r_0(start={0,0,1}, each fixed=true),
    v_0(start={0.5,-0.2,3}, each fixed=true),
    angles_fixed=true,
    angles_start={2.5,-1.1,0.7},
    w_0_fixed=true,
    w_0_start={1,7,-3}) "Unit length of the quaternion as a constraint";
  ContactMultiBody.Parts.FreeBody unconstrained(
    m=2,
    r_CM={0.1,-0.05,0.02},
    I_11=0.02,
    I_22=0.05,
    I_33=0.04,
    I_21=0.003,
    I_31=-0.002,
    I_32=0.004,
    r_0(start={0,0,1}, each fixed=true),
    v_0(start={0.5,-0.2,3}, each fixed=true),
    angles_fixed=true,
    angles_start={2.5,-1.1,0.7},
    w_0_fixed=true,
    w_0_start={1,7,-3}) "Four differential equations";
  Modelica.Units.SI.Distance positionDifference "Largest difference of a coordinate";
  Real rotationDifference(unit="1") "Largest difference of an element of the rotation matrices";
  Real lengthError(unit="1") "Error of the square of the quaternion's length";
equation
  positionDifference = max(abs(constrained.frame_a.r_0 - unconstrained.frame_a.r_0));
  rotationDifference = max(abs(constrained.frame_a.R.T - unconstrained.frame_a.R.T));
  lengthError = unconstrained.Q*unconstrained.Q - 1;
  annotation (experiment(StopTime=2, Tolerance=1e-12, Interval=0.01), Documentation(info="<html>
<p>The centre of mass is off the frame and the inertia tensor has no zero: all terms of the equations of motion count. The differences stay below 1e-9.</p>
</html>"));
end BodiesOfTwoForms;
