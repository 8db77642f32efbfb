within ContactMultiBodyTest.Agreement;
model LawsByBothWays "Every law of the normal force by the equations of the library and by the engine"
  extends Modelica.Icons.Example;
  import NormalLaw = ContactMultiBody.Types.NormalLaw;
  SpheresByBothWays exact(law=NormalLaw.Exact);
  SpheresByBothWays juhasz(law=NormalLaw.Juhasz);
  SpheresByBothWays huntCrossley(law=NormalLaw.HuntCrossley);
  SpheresByBothWays herbertMcWhannell(law=NormalLaw.HerbertMcWhannell);
  SpheresByBothWays leeWang(law=NormalLaw.LeeWang);
  SpheresByBothWays lankaraniNikravesh(law=NormalLaw.LankaraniNikravesh);
  SpheresByBothWays gonthier(law=NormalLaw.Gonthier);
  SpheresByBothWays flores(law=NormalLaw.Flores);
  SpheresByBothWays huGuo(law=NormalLaw.HuGuo);
  annotation (experiment(StopTime=50, Tolerance=1e-6, Interval=0.1), Documentation(info="<html>
<p>The differences of each <code>comparison</code> stay zero to rounding.</p>
</html>"));
end LawsByBothWays;
