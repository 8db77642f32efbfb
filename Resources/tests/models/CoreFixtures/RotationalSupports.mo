within CoreFixtures;
model RotationalSupports "Motor on a housing that is held by a spring; rack and pinion"
  extends Modelica.Icons.Example;
  import Modelica.Mechanics.Rotational;
  import Modelica.Mechanics.Translational;
  Rotational.Sources.ConstantTorque motor(useSupport=true, tau_constant=2);
  Rotational.Components.Inertia rotor(J=0.1, phi(fixed=true, start=0), w(fixed=true, start=0));
  Rotational.Components.Inertia housing(J=1, phi(fixed=true, start=0), w(fixed=true, start=0));
  Rotational.Components.Spring mount(c=10);
  Rotational.Components.Fixed ground;
  Rotational.Components.IdealGear gear(useSupport=true, ratio=-3);
  Rotational.Components.IdealGearR2T pinion(ratio=20, useSupportR=true);
  Translational.Components.Mass slide(m=2);
equation
  connect(motor.flange, rotor.flange_a);
  connect(motor.support, housing.flange_a);
  connect(housing.flange_b, mount.flange_a);
  connect(mount.flange_b, ground.flange);
  connect(rotor.flange_b, gear.flange_a);
  connect(gear.support, housing.flange_a);
  connect(gear.flange_b, pinion.flangeR);
  connect(pinion.supportR, housing.flange_a);
  connect(pinion.flangeT, slide.flange_a);
  annotation (experiment(StopTime=0.5, Tolerance=1e-9));
end RotationalSupports;
