within ContactMultiBody.Internal.Engine;
pure function compiledResponse "Contact forces on all bodies of a scene, found and computed by the engine"
  extends Modelica.Icons.Function;
  input Integer broadphase "Handle from internBroadphase";
  input Modelica.Units.SI.Position r_0[:, 3] "Origins of the bodies' frames, in world axes";
  input Real T[size(r_0, 1), 3, 3](each unit="1") "Rotation from world to each body's frame";
  input Modelica.Units.SI.Velocity v_0[size(r_0, 1), 3] "Velocities of the origins, in world axes";
  input Modelica.Units.SI.AngularVelocity w_0[size(r_0, 1), 3] "Angular velocities, in world axes";
  input Modelica.Units.SI.Mass m[size(r_0, 1)] "Masses";
  input Modelica.Units.SI.Position r_CM[size(r_0, 1), 3] "Centres of mass, in the bodies' frames";
  input Modelica.Units.SI.Inertia I[size(r_0, 1), 3, 3] "Inertia tensors about them, in the bodies' frames";
  input Real stiffness[size(r_0, 1)] "Stiffness of each body, without Hertz";
  input Modelica.Units.SI.Stress modulus[size(r_0, 1)] "E/(1 - nu^2) of each body, for Hertz";
  input Real curvature[size(r_0, 1)](each unit="1/m") "Curvature of each body, for Hertz";
  input Real restitution[size(r_0, 1)](each unit="1") "Coefficient of restitution of each body's material";
  input Real muStatic[size(r_0, 1)](each unit="1") "Coefficient of static friction of each body's material";
  input Real muDynamic[size(r_0, 1)](each unit="1") "Coefficient of sliding friction of each body's material";
  input Integer choice[6] "Law; 1 with restitution; 1 with Hertz; rule of restitution; 1 with friction; rule of friction";
  input Real number[9]
    "Exponent, steady rate, damping, its depth, regularisation speed, Stribeck speed, spin radius, rolling lever, turning speed";
  output Modelica.Units.SI.Force force[size(r_0, 1), 3] "Force on each body, in world axes";
  output Modelica.Units.SI.Torque torque[size(r_0, 1), 3] "Torque on each body about its frame, in world axes";
  output Modelica.Units.SI.Energy elasticEnergy "Energy stored in all contacts";
  output Real contactCount(unit="1") "Number of pairs that touch";
  output Modelica.Units.SI.Length largestDepth "Largest penetration depth";
  output Real relativeDepth(unit="1") "Largest penetration depth by the thickness of the thinner body";
external "C" cmb_modelica_response(broadphase, r_0, size(r_0, 1), T, v_0, w_0, m, r_CM, I, stiffness, modulus, curvature, restitution, muStatic, muDynamic, choice, number, force, torque, elasticEnergy, contactCount, largestDepth, relativeDepth)
  annotation (
    Include="#include \"contact_multibody_scene_modelica.h\"",
    IncludeDirectory="modelica://ContactMultiBody/Resources/Include",
    LibraryDirectory="modelica://ContactMultiBody/Resources/Library",
    Library={"ContactMultiBody"});
  annotation (Documentation(info="<html>
<p>
The laws of <a href=\"modelica://ContactMultiBody.NormalForce\">NormalForce</a> and
<a href=\"modelica://ContactMultiBody.Friction\">Friction</a>, compiled. The result depends on the arguments alone, so that an integrator may
evaluate in any order and discard steps.
</p>
</html>"));
end compiledResponse;
