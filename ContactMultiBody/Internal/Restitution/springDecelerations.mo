within ContactMultiBody.Internal.Restitution;
pure function springDecelerations "How fast the springs of each pair slow its points down"
  extends Modelica.Icons.Function;
  import SI = Modelica.Units.SI;
  input SI.Length depth[:, :] "Penetration depths";
  input Real weight[size(depth, 1), size(depth, 2)](each unit="1") "Weights of the points";
  input Real normal[size(depth, 1), size(depth, 2), 3](each unit="1") "Normals";
  input SI.Position point[size(depth, 1), size(depth, 2), 3] "Contact points";
  input Real stiffness[size(depth, 1)] "Stiffness of each pair";
  input Real exponent(unit="1") "Exponent of the depth";
  input Integer pairs[size(depth, 1), 2] "Bodies of each pair";
  input SI.Position r_0[:, 3] "Origins of the bodies' frames";
  input Real T[size(r_0, 1), 3, 3](each unit="1") "Rotation from the world to each body's frame";
  input SI.Mass mass[size(r_0, 1)] "Masses of the bodies; 0: immovable";
  input SI.Position r_CM[size(r_0, 1), 3] "Centres of mass, in the bodies' frames";
  input Real inverseInertia[size(r_0, 1), 3, 3](each unit="1/(kg.m2)") "Inverse tensors of inertia, in the bodies' frames";
  input SI.Mass effectiveMass[size(depth, 1)] "Effective mass of each pair; 0: from the bodies";
  output SI.Acceleration deceleration[size(depth, 1), size(depth, 2)] "Decelerations along the normals; 0 at points that do not touch";
protected
  constant Real leastShare(unit="1")=0.1 "Least deceleration by that of the point's own spring";
  Integer body "A body of the pair";
  Real R[3, 3](each unit="1") "Rotation from the world to its frame";
  Real J[3, 3](each unit="1/(kg.m2)") "Its inverse tensor of inertia";
  SI.Position arm[3] "From the centre of mass to a point, in the body's frame";
  Real e[3](each unit="1") "Normal in the body's frame";
  SI.Force spring "Force of a spring";
  SI.Force force[3] "Resultant of the springs of a pair, in the body's frame";
  SI.Torque torque[3] "Their torque about the centre of mass, in the body's frame";
  SI.Acceleration alone[size(depth, 1), size(depth, 2)] "Decelerations of each point by its own spring";
algorithm
  deceleration := zeros(size(depth, 1), size(depth, 2));
  alone := zeros(size(depth, 1), size(depth, 2));
  for i in 1:size(depth, 1) loop
    for side in 1:2 loop
      body := pairs[i, side];
      R := T[body, :, :];
      J := inverseInertia[body, :, :];
      force := zeros(3);
      torque := zeros(3);
      for k in 1:size(depth, 2) loop
        spring := weight[i, k]*NormalForce.normalForce(depth[i, k], 0, stiffness[i], exponent, 0);
        e := R*normal[i, k, :];
        arm := R*(point[i, k, :] - r_0[body, :]) - r_CM[body, :];
        force := force + (if depth[i, k] > 0 then spring*e else zeros(3));
        torque := torque + (if depth[i, k] > 0 then spring*cross(arm, e) else zeros(3));
      end for;
      for k in 1:size(depth, 2) loop
        e := R*normal[i, k, :];
        arm := R*(point[i, k, :] - r_0[body, :]) - r_CM[body, :];
        spring := weight[i, k]*NormalForce.normalForce(depth[i, k], 0, stiffness[i], exponent, 0);
        deceleration[i, k] := deceleration[i, k] + (if depth[i, k] > 0 then (if mass[body] > 0 then force*e/mass[body] else 0)
           + (J*torque)*cross(arm, e) else 0);
        alone[i, k] := alone[i, k] + (if depth[i, k] > 0 then spring*((if mass[body] > 0 then 1/mass[body] else 0) +
          (J*cross(arm, e))*cross(arm, e)) else 0);
      end for;
    end for;
    for k in 1:size(depth, 2) loop
      deceleration[i, k] := if effectiveMass[i] > 0 then NormalForce.normalForce(depth[i, k], 0, stiffness[i], exponent, 0)/
        effectiveMass[i] else max(deceleration[i, k], leastShare*alone[i, k]);
    end for;
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>
Newton's and Euler's equations of both bodies under the elastic forces of the pair: for one point K x<sup>n</sup>/m with the
effective mass 1/m = 1/m<sub>1</sub> + 1/m<sub>2</sub> + (r<sub>1</sub>&times;n) I<sub>1</sub><sup>-1</sup> (r<sub>1</sub>&times;n) +
(r<sub>2</sub>&times;n) I<sub>2</sub><sup>-1</sup> (r<sub>2</sub>&times;n); where several points carry, each counts with its share. The springs of
other points may lever a point into its contact, so that nothing would slow it down; it then counts at least a tenth of what its own spring would
do alone. Without that bound the force would jump where the speed of such a point passes zero.
</p>
</html>"));
end springDecelerations;
