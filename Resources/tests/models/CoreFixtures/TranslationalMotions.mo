within CoreFixtures;
model TranslationalMotions "Prescribed translations"
  extends Modelica.Icons.Example;
  import Modelica.Mechanics.Translational;
  Modelica.Blocks.Sources.Cosine cosine(amplitude=0.4, f=1, phase=0.5);
  Modelica.Blocks.Sources.Constant speedReference(k=3);
  Translational.Sources.Position exact(exact=true);
  Translational.Sources.Position filtered(f_crit=20);
  Translational.Sources.Speed speed(f_crit=10);
  Translational.Sources.ConstantSpeed constantSpeed(v_fixed=2, s(fixed=true, start=0.1));
  Translational.Components.Mass mass[4](each m=0.3);
equation
  exact.s_ref = 0.2*sin(3*time);
  connect(cosine.y, filtered.s_ref);
  connect(speedReference.y, speed.v_ref);
  connect(exact.flange, mass[1].flange_a);
  connect(filtered.flange, mass[2].flange_a);
  connect(speed.flange, mass[3].flange_a);
  connect(constantSpeed.flange, mass[4].flange_a);
  annotation (experiment(StopTime=1, Tolerance=1e-9));
end TranslationalMotions;
