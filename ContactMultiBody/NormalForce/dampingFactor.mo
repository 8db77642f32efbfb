within ContactMultiBody.NormalForce;
pure function dampingFactor "Damping factor of the law chosen"
  extends Modelica.Icons.Function;
  input Types.NormalLaw law "Law of the normal force";
  input Real restitution(min=0, max=1, unit="1") "Coefficient of restitution";
  output Real damping(unit="1") "Damping factor d";
algorithm
  damping := if law == Types.NormalLaw.Exact then exact(restitution)
    elseif law == Types.NormalLaw.Juhasz then juhasz(restitution)
    elseif law == Types.NormalLaw.HuntCrossley then huntCrossley(restitution)
    elseif law == Types.NormalLaw.HerbertMcWhannell then herbertMcWhannell(restitution)
    elseif law == Types.NormalLaw.LeeWang then leeWang(restitution)
    elseif law == Types.NormalLaw.LankaraniNikravesh then lankaraniNikravesh(restitution)
    elseif law == Types.NormalLaw.Gonthier then gonthier(restitution)
    elseif law == Types.NormalLaw.Flores then flores(restitution)
    elseif law == Types.NormalLaw.HuGuo then huGuo(restitution)
    else 0;
  annotation (Documentation(info="<html>
<p>Calls the function of the law. SpringDamper has no damping factor; 0 is returned for it.</p>
</html>"));
end dampingFactor;
