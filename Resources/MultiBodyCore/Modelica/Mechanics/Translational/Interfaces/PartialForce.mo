within Modelica.Mechanics.Translational.Interfaces;
partial model PartialForce "Source of a force"
  extends PartialElementaryOneFlangeAndSupport2;
  SI.Force f "Force on the flange";
equation
  f = flange.f;
  annotation (Documentation(info="<html><p>Base class of sources of a force.</p></html>"));
end PartialForce;
