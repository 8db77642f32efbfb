within ContactMultiBodyTest.Laws;
model DampingFactors "Every law has the damping factor its source gives"
  extends Modelica.Icons.Example;
  parameter Real e[5]={0.1,0.3,0.5,0.7,0.9} "Coefficients of restitution asked for";
  Real exact[5] "Exact law";
  Real juhasz[5] "Juhasz";
  Real huntCrossley[5] "Hunt and Crossley";
  Real herbertMcWhannell[5] "Herbert and McWhannell";
  Real leeWang[5] "Lee and Wang";
  Real lankaraniNikravesh[5] "Lankarani and Nikravesh";
  Real gonthier[5] "Gonthier et al.";
  Real flores[5] "Flores et al.";
  Real huGuo[5] "Hu and Guo";
  Real delivered[8, 5] "Restitution delivered by the published laws, in the order above";
  Real exactElastic "Exact law for e = 1";
  Real exactPlastic "Exact law for e = 0, bounded";
  Real exactNearlyElastic[3] "Exact law for e = 0.979, 0.981, 0.999";
equation
  for i in 1:5 loop
    exact[i] = ContactMultiBody.NormalForce.exact(e[i]);
  end for;
  for i in 1:5 loop
    juhasz[i] = ContactMultiBody.NormalForce.juhasz(e[i]);
  end for;
  for i in 1:5 loop
    huntCrossley[i] = ContactMultiBody.NormalForce.huntCrossley(e[i]);
  end for;
  for i in 1:5 loop
    herbertMcWhannell[i] = ContactMultiBody.NormalForce.herbertMcWhannell(e[i]);
  end for;
  for i in 1:5 loop
    leeWang[i] = ContactMultiBody.NormalForce.leeWang(e[i]);
  end for;
  for i in 1:5 loop
    lankaraniNikravesh[i] = ContactMultiBody.NormalForce.lankaraniNikravesh(e[i]);
  end for;
  for i in 1:5 loop
    gonthier[i] = ContactMultiBody.NormalForce.gonthier(e[i]);
  end for;
  for i in 1:5 loop
    flores[i] = ContactMultiBody.NormalForce.flores(e[i]);
  end for;
  for i in 1:5 loop
    huGuo[i] = ContactMultiBody.NormalForce.huGuo(e[i]);
  end for;
  for i in 1:5 loop
    delivered[1, i] = ContactMultiBody.NormalForce.deliveredRestitution(juhasz[i]);
  end for;
  for i in 1:5 loop
    delivered[2, i] = ContactMultiBody.NormalForce.deliveredRestitution(huntCrossley[i]);
  end for;
  for i in 1:5 loop
    delivered[3, i] = ContactMultiBody.NormalForce.deliveredRestitution(herbertMcWhannell[i]);
  end for;
  for i in 1:5 loop
    delivered[4, i] = ContactMultiBody.NormalForce.deliveredRestitution(leeWang[i]);
  end for;
  for i in 1:5 loop
    delivered[5, i] = ContactMultiBody.NormalForce.deliveredRestitution(lankaraniNikravesh[i]);
  end for;
  for i in 1:5 loop
    delivered[6, i] = ContactMultiBody.NormalForce.deliveredRestitution(gonthier[i]);
  end for;
  for i in 1:5 loop
    delivered[7, i] = ContactMultiBody.NormalForce.deliveredRestitution(flores[i]);
  end for;
  for i in 1:5 loop
    delivered[8, i] = ContactMultiBody.NormalForce.deliveredRestitution(huGuo[i]);
  end for;
  exactElastic = ContactMultiBody.NormalForce.exact(1);
  exactPlastic = ContactMultiBody.NormalForce.exact(0);
  exactNearlyElastic[1] = ContactMultiBody.NormalForce.exact(0.979);
  exactNearlyElastic[2] = ContactMultiBody.NormalForce.exact(0.981);
  exactNearlyElastic[3] = ContactMultiBody.NormalForce.exact(0.999);
  annotation (experiment(StopTime=1, Tolerance=1e-6), Documentation(info="<html>
<p>Variables are compared with the closed forms and, for the exact law, with high-precision solutions.</p>
</html>"));
end DampingFactors;
